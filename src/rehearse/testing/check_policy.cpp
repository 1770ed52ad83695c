#include "rehearse/testing/check_policy.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/testing/compare.hpp"

namespace rehearse::testing {
namespace {

constexpr Index kRows = 37;  // no multiple of a vector's length

class PolicyCheck {
 public:
  PolicyCheck(const policy::Policy& policy, const Task& task, std::uint64_t seed)
      : policy_(policy), task_(task), rng_({.seed = seed}) {
    Theta_ = normals(policy.parameters(), 2);
    X_ = normals(task.state_size(), 1).array().rowwise() + task.start_mean.transpose().array();
  }

  std::vector<std::string> run() {
    for (const double t_s : {0.0, task_.dt_s, task_.episode_s()}) {
      whole_ = act(Theta_, X_, t_s);
      if (!whole_.allFinite()) found_.add(fmt::format("an action at t = {} s is not finite", t_s));
      check_bounds(whole_, "ordinary θ and states");
      check_rows(t_s);
      check_padding(t_s);
      for (const double bad : {kNaN, kInf, -kInf, 1e300, -1e300}) check_hostile(bad, t_s);
    }
    for (const double size : {0.0, 1e-300, 1e3, 1e6})
      check_bounds(act(size * Theta_, X_, 0), fmt::format("θ × {}", size));
    return found_.list();
  }

 private:
  Matrix normals(Index columns, double deviation) {
    Matrix numbers(kRows, columns);
    for (double& value : numbers.reshaped()) value = deviation * rng_.normal();
    return numbers;
  }

  Matrix act(const ConstMatrixView& Theta, const ConstMatrixView& X, double t_s) const {
    Matrix U = Matrix::Constant(X.rows(), policy_.actions(), kNaN);
    policy_.act(Theta, X, t_s, U);
    return U;
  }

  /// A NaN is inside no bounds, but may answer a state that is not finite.
  void check_bounds(const Matrix& U, const std::string& what) {
    for (Index c = 0; c < U.cols(); ++c) {
      const ActionVariable& action = task_.actions[static_cast<std::size_t>(c)];
      for (Index r = 0; r < U.rows(); ++r)
        if (U(r, c) < action.bounds.low || U(r, c) > action.bounds.high)
          return found_.add(fmt::format("action {} = {} is outside its bounds {} to {} ({})", action.name, U(r, c),
                                        action.bounds.low, action.bounds.high, what));
    }
  }

  void check_rows(double t_s) {
    for (Index i = 0; i < kRows; ++i)
      if (!same(act(Theta_.middleRows(i, 1), X_.middleRows(i, 1), t_s), whole_.middleRows(i, 1)))
        return found_.add(fmt::format("row {} by itself gives other bytes than in the batch", i));
    if (!same(act(Theta_, X_, t_s), whole_)) found_.add("the same call gives other bytes when it is repeated");
  }

  /// θ and states as blocks of larger matrices, with NaN around them.
  void check_padding(double t_s) {
    Matrix Theta = Matrix::Constant(kRows + 2, Theta_.cols() + 2, kNaN),
           X = Matrix::Constant(kRows + 2, X_.cols() + 2, kNaN);
    Theta.block(1, 1, kRows, Theta_.cols()) = Theta_;
    X.block(1, 1, kRows, X_.cols()) = X_;
    const Matrix U = act(Theta.block(1, 1, kRows, Theta_.cols()), X.block(1, 1, kRows, X_.cols()), t_s);
    found_.require(same(U, whole_), "reads more than its parameters() columns of θ and its rows");
  }

  void check_hostile(double bad, double t_s) {
    Matrix X = X_;
    const Index middle = kRows / 2, last = kRows - 1;
    for (const Index row : {middle, last}) X.row(row).setConstant(bad);
    const Matrix U = act(Theta_, X, t_s);
    Matrix expected = whole_;
    for (const Index row : {middle, last}) expected.row(row) = U.row(row);
    found_.require(same(U, expected), fmt::format("a state of {} disturbs other rows", bad));
    check_bounds(U, fmt::format("a state of {}", bad));
    if (std::isnan(bad))
      found_.require(U.row(middle).array().isNaN().all() && U.row(last).array().isNaN().all(),
                     "a NaN state is answered with an action");
  }

  const policy::Policy& policy_;
  const Task& task_;
  Rng rng_;
  Matrix Theta_, X_, whole_;
  Violations found_;
};

}  // namespace

std::vector<std::string> check_policy(const policy::Policy& policy, const Task& task, std::uint64_t seed) {
  Violations sizes;
  sizes.require(policy.parameters() >= 1, fmt::format("parameters() = {}, must be ≥ 1", policy.parameters()));
  sizes.require(policy.actions() == task.action_size(),
                fmt::format("actions() = {}, must be the task's {}", policy.actions(), task.action_size()));
  if (!sizes.empty()) return sizes.list();
  return PolicyCheck(policy, task, seed).run();
}

}  // namespace rehearse::testing
