#include "rehearse/moments/squash_moments.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/test/reference.hpp"
#include "rehearse/moments/test/gaussian_tools.hpp"

namespace rehearse::moments {
namespace {

/// PILCO's index: the entries of x that are squashed.
std::vector<Index> squashed(const nlohmann::json& test) {
  std::vector<Index> indices;
  for (const double index : reference::vector(test["index_1based"])) indices.push_back(static_cast<Index>(index) - 1);
  return indices;
}

std::vector<Interval> symmetric_bounds(const Vector& half_widths) {
  std::vector<Interval> bounds;
  for (const double w : half_widths) bounds.push_back({-w, w});
  return bounds;
}

/// The row of a derivative by a d × d matrix, without what is not squashed, symmetrised.
Matrix by_covariance(const Matrix& row, Index size, const std::vector<Index>& indices) {
  const Matrix square = row.reshaped(size, size)(indices, indices);
  return square + square.transpose();
}

TEST(SquashMoments, AgreeWithPilcoIncludingDerivatives) {
  const nlohmann::json pilco = reference::load("g_squash.json");
  for (const auto& test : pilco["cases"]) {
    const auto& expected = test["gSat"];
    const std::vector<Index> indices = squashed(test);
    const Vector m = reference::vector(test["m"]);
    const Gaussian a{m(indices), reference::matrix(test["v"])(indices, indices)};
    const SquashMoments squash(symmetric_bounds(reference::vector(test["scale_e"])));
    const Transformed result = squash(a);
    const Matrix gain = reference::matrix(expected["C"])(indices, Eigen::all);
    EXPECT_LT(reference::error(result.mean, reference::matrix(expected["M"])), 1e-9) << test["name"];
    EXPECT_LT(reference::error(result.covariance, reference::matrix(expected["V"])), 1e-9) << test["name"];
    EXPECT_LT(reference::error(result.gain, gain), 1e-9) << test["name"];

    const Index E = a.size();
    const auto expect = [&](const std::string& of, Index row, const Transformed& by) {
      Gaussian adjoint = Gaussian::zero(E);
      squash.adjoint(a, by, adjoint);
      const auto derivative = [&](const std::string& variable) {
        const Matrix matrix = reference::matrix(expected["d" + of + "d" + variable]);
        return Matrix(matrix
                          .reshaped(of == "M"   ? E
                                    : of == "V" ? E * E
                                                : m.size() * E,
                                    variable == "m" ? m.size() : m.size() * m.size())
                          .row(row));
      };
      EXPECT_LT(reference::error(adjoint.mean, derivative("m").reshaped()(indices)), 1e-9) << test["name"] << of << row;
      EXPECT_LT(reference::error(adjoint.covariance + adjoint.covariance.transpose(),
                                 by_covariance(derivative("v"), m.size(), indices)),
                1e-9)
          << test["name"] << of << row;
    };
    const Transformed none = Transformed::zero(E, E);
    for (Index k = 0; k < E; ++k) {
      Transformed by = none;
      by.mean(k) = 1;
      expect("M", k, by);
      by = none;
      by.gain(k, k) = 1;
      expect("C", k * m.size() + indices[static_cast<std::size_t>(k)], by);
    }
    for (Index k = 0; k < E * E; ++k) {
      Transformed by = none;
      by.covariance(k % E, k / E) = 1;
      expect("V", k, by);
    }
  }
}

TEST(SquashMoments, AgreeWithSamplesForAnyBounds) {
  const SquashMoments squash({{-1, 3}, {2, 2.5}});
  const Gaussian a = tools::random_gaussian(2, 0.5, 1);
  const auto f = [](const Vector& at, const Vector&) {
    const auto s = [](double x) { return (9 * std::sin(x) + std::sin(3 * x)) / 8; };
    return Vector{{1 + 2 * s(at(0)), 2.25 + 0.25 * s(at(1))}};
  };
  tools::expect_samples(f, a, squash(a), 2);
}

}  // namespace
}  // namespace rehearse::moments
