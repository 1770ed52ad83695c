#include "rehearse/moments/sine_moments.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "gaussian_tools.hpp"
#include "rehearse/core/test/reference.hpp"

namespace rehearse::moments {
namespace {

/// Features in PILCO's order: sine, cosine of each angle.
std::vector<Sine> trigonometry(const nlohmann::json& test) {
  const Vector angles = reference::vector(test["angle_index_1based"]), scale = reference::vector(test["scale_e"]);
  std::vector<Sine> sines;
  for (Index k = 0; k < angles.size(); ++k) {
    const auto input = static_cast<Index>(angles(k)) - 1;
    sines.push_back({.output = 2 * k, .input = input, .amplitude = scale(k)});
    sines.push_back({.output = 2 * k + 1, .input = input, .amplitude = scale(k), .phase = std::numbers::pi / 2});
  }
  return sines;
}

/// The derivatives of one entry of the results, PILCO's rows of dMdm, dMdv and so on, those by a covariance
/// symmetrised.
struct Rows {
  Vector by_mean, by_covariance;
};
Rows rows(const nlohmann::json& test, const std::string& of, Index entry) {
  const Matrix by_mean = reference::matrix(test["d" + of + "dm"]), by_v = reference::matrix(test["d" + of + "dv"]);
  const auto D = static_cast<Index>(test["m"].size());
  const Matrix square = by_v.row(entry).reshaped(D, D);
  return {by_mean.row(entry).transpose(), (square + square.transpose()).reshaped()};
}

TEST(SineMoments, AgreeWithPilcoIncludingDerivatives) {
  const nlohmann::json pilco = reference::load("c_gtrig.json");
  for (const auto& test : pilco["cases"]) {
    const std::vector<Sine> sines = trigonometry(test);
    const Gaussian x{reference::vector(test["m"]), reference::matrix(test["v"])};
    const auto outputs = static_cast<Index>(sines.size()), D = x.size();
    const Transformed result = sine_moments(sines, outputs, x);
    EXPECT_LT(reference::error(result.mean, reference::matrix(test["M"])), 1e-9) << test["name"];
    EXPECT_LT(reference::error(result.covariance, reference::matrix(test["V"])), 1e-9) << test["name"];
    EXPECT_LT(reference::error(result.gain, reference::matrix(test["C"])), 1e-9) << test["name"];

    const auto expect = [&](const std::string& of, Index entry, const Transformed& by) {
      Gaussian adjoint = Gaussian::zero(D);
      sine_adjoint(sines, x, by, adjoint);
      const Rows expected = rows(test, of, entry);
      EXPECT_LT(reference::error(adjoint.mean, expected.by_mean), 1e-9) << test["name"] << of << entry;
      const Matrix symmetric = adjoint.covariance + adjoint.covariance.transpose();
      EXPECT_LT(reference::error(symmetric.reshaped(), expected.by_covariance), 1e-9) << test["name"] << of << entry;
    };
    const Transformed none = Transformed::zero(D, outputs);
    for (Index k = 0; k < outputs; ++k) {
      Transformed by = none;
      by.mean(k) = 1;
      expect("M", k, by);
    }
    for (Index k = 0; k < outputs * outputs; ++k) {
      Transformed by = none;
      by.covariance(k % outputs, k / outputs) = 1;
      expect("V", k, by);
    }
    for (Index k = 0; k < D * outputs; ++k) {
      Transformed by = none;
      by.gain(k % D, k / D) = 1;
      expect("C", k, by);
    }
  }
}

TEST(SineMoments, AgreeWithSamples) {
  const std::vector<Sine> sines{{.output = 0, .input = 1, .amplitude = 0.7, .frequency = 2, .phase = 0.3},
                                {.output = 1, .input = 0},
                                {.output = 1, .input = 2, .amplitude = -1.5, .frequency = 0.5, .phase = 1}};
  const Gaussian x = tools::random_gaussian(3, 0.8, 1);
  const auto f = [&](const Vector& at, const Vector&) {
    Vector y = Vector::Zero(2);
    for (const Sine& s : sines) y(s.output) += s.amplitude * std::sin(s.frequency * at(s.input) + s.phase);
    return y;
  };
  tools::expect_samples(f, x, sine_moments(sines, 2, x), 2);
}

TEST(SineMoments, OfAVeryUncertainAngleAreThoseOfTheCircle) {
  const std::vector<Sine> sines{{.output = 0}, {.output = 1, .phase = std::numbers::pi / 2}};
  for (const double variance : {100.0, 1e4, 1e300}) {
    const Transformed result = sine_moments(sines, 2, {Vector::Zero(1), Matrix::Constant(1, 1, variance)});
    EXPECT_LT(result.mean.norm(), 1e-20);
    EXPECT_LT((result.covariance - Matrix::Identity(2, 2) / 2).norm(), 1e-12);
    EXPECT_LT(result.gain.norm(), 1e-20);
  }
}

}  // namespace
}  // namespace rehearse::moments
