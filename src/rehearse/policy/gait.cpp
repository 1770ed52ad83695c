#include "rehearse/policy/gait.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/policy/description.hpp"

namespace rehearse::policy {
namespace {

constexpr int kSamples = 100, kHalfWidth = 10;
constexpr double kWidth = 3;  // samples
constexpr Index kParametersOfLeg = 6, kJointsOfLeg = 3;

/// cumulative[i]: the weight of the first i samples of the smoothing window.
std::array<double, 2 * kHalfWidth + 2> cumulative_weights() {
  std::array<double, 2 * kHalfWidth + 2> cumulative{};
  for (int i = 0; i <= 2 * kHalfWidth; ++i) {
    const double z = (i - kHalfWidth) / kWidth;
    cumulative[static_cast<std::size_t>(i) + 1] = cumulative[static_cast<std::size_t>(i)] + std::exp(-z * z / 2);
  }
  for (double& weight : cumulative) weight /= cumulative.back();
  return cumulative;
}

/// The weight of the window's samples from `begin` to before `end`, counted from its middle.
double weight_between(int begin, int end) {
  static const auto cumulative = cumulative_weights();
  const auto at = [](int i) { return static_cast<std::size_t>(std::clamp(i + kHalfWidth, 0, 2 * kHalfWidth + 1)); };
  return cumulative[at(end)] - cumulative[at(begin)];
}

int samples(double fraction) { return static_cast<int>(kSamples * std::clamp(fraction, 0.0, 1.0)); }

class Gait final : public Policy, public Describable {
 public:
  explicit Gait(Index legs) : legs_(legs) {}
  std::string name() const override { return "gait"; }
  Index parameters() const override { return legs_ * kParametersOfLeg; }
  Index actions() const override { return legs_ * kJointsOfLeg; }
  std::optional<Interval> box() const override { return Interval{0, 1}; }
  Matrix examples() const override {
    const Vector tripod = tripod_gait();
    return parameters() == tripod.size() ? Matrix(tripod.transpose()) : Policy::examples();
  }

  void act(const ConstMatrixView& Theta, const ConstMatrixView& X, double t_s, MatrixView U) const override {
    check_sizes(*this, -1, Theta, X, U);
    constexpr double eighth = std::numbers::pi / 8;
    for (Index i = 0; i < Theta.rows(); ++i)
      for (Index leg = 0; leg < legs_; ++leg) {
        const auto signal = [&](Index first) {
          const Index at = leg * kParametersOfLeg + first;
          return gait_signal(Theta(i, at), Theta(i, at + 1), Theta(i, at + 2), t_s);
        };
        const double lift = 2 * eighth * signal(3);
        U(i, leg * kJointsOfLeg) = eighth * signal(0);
        U(i, leg * kJointsOfLeg + 1) = lift;
        U(i, leg * kJointsOfLeg + 2) = -lift;
      }
    for (Index i = 0; i < X.rows(); ++i)
      if (X.row(i).hasNaN()) U.row(i).setConstant(kNaN);
  }

  /// One period.
  Description describe(const ConstVectorView& theta) const override {
    Table table{.actions = Matrix(kSamples, actions()), .per_s = kSamples, .periodic = true};
    const Matrix Theta = theta.transpose(), X = Matrix::Zero(1, 1);
    for (Index i = 0; i < kSamples; ++i)
      act(Theta, X, static_cast<double>(i) / kSamples, table.actions.middleRows(i, 1));
    return {std::move(table)};
  }

 private:
  Index legs_;
};

}  // namespace

double gait_signal(double amplitude, double phase, double duty, double t_s) {
  const int high = samples(duty);
  const int now = static_cast<int>(std::lround(t_s * kSamples) + samples(phase)) % kSamples;
  double weight = 0;  // of the window's samples that are high, in this period and its neighbours
  for (const int period : {-kSamples, 0, kSamples}) weight += weight_between(period - now, period + high - now);
  return std::clamp(amplitude, 0.0, 1.0) * (2 * weight - 1);
}

std::shared_ptr<const Policy> make_gait(Index legs) {
  if (legs < 1) throw InvalidInput(fmt::format("legs = {}, must be ≥ 1", legs));
  return std::make_shared<Gait>(legs);
}

Vector tripod_gait() {
  return Vector{{1, 0, .5, .25, .25, .5, 1, .5, .5, .25, .75, .5, 1, 0, .5, .25, .25, .5,
                 1, 0, .5, .25, .75, .5, 1, .5, .5, .25, .25, .5, 1, 0, .5, .25, .75, .5}};
}

}  // namespace rehearse::policy
