#include "rehearse/testing/check_simulator.hpp"

#include <limits>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/testing/compare.hpp"

namespace rehearse::testing {
namespace {

class SimulatorCheck {
 public:
  SimulatorCheck(const system::Simulator& simulator, const ConstMatrixView& X, const ConstMatrixView& U,
                 const Vector& phi)
      : simulator_(simulator), X_(X), U_(U), phi_(phi), whole_(change(X, U)) {}

  std::vector<std::string> run() {
    const Index failed = (whole_.array().isNaN().rowwise().any()).count();
    found_.require(failed == 0, fmt::format("{} of the {} sample rows cannot be simulated", failed, X_.rows()));
    check_repetition();
    check_parts();
    check_threads();
    for (const double value : {kNaN, kInf, -kInf, 1e300, -1e300}) check_hostile(value);
    return found_.list();
  }

 private:
  Matrix change(const ConstMatrixView& X, const ConstMatrixView& U) const {
    Matrix dX = Matrix::Constant(X.rows(), X.cols(), -7);
    system::change_contained(simulator_, X, U, phi_, dX);
    return dX;
  }

  void check_repetition() {
    found_.require(same(change(X_, U_), whole_), "the same call gives other bytes when it is repeated");
  }

  void check_parts() {
    const Index n = X_.rows();
    for (Index i = 0; i < n; ++i)
      if (!same(change(X_.middleRows(i, 1), U_.middleRows(i, 1)), whole_.middleRows(i, 1)))
        return found_.add(fmt::format("row {} by itself gives other bytes than in the batch", i));
    for (Index first = 0; first < n; ++first)
      if (!same(change(X_.bottomRows(n - first), U_.bottomRows(n - first)), whole_.bottomRows(n - first)))
        return found_.add(fmt::format("rows {} to {} give other bytes than in the batch", first, n - 1));
  }

  void check_threads() {
    constexpr Index kCalls = 16;
    std::vector<Matrix> results(kCalls);
    make_thread_evaluator(4)->for_each(kCalls, [&](Index i) { results[static_cast<std::size_t>(i)] = change(X_, U_); });
    for (const Matrix& result : results)
      if (!same(result, whole_)) return found_.add("calls from several threads at once give other bytes");
  }

  /// `value` in every column of the first, a middle and the last row, then in one column at a time of the middle row.
  void check_hostile(double value) {
    const Index last = X_.rows() - 1, middle = X_.rows() / 2;
    Matrix X = X_, U = U_;
    for (const Index row : {Index{0}, middle, last}) X.row(row).setConstant(value), U.row(row).setConstant(value);
    compare(X, U, {0, middle, last}, fmt::format("rows of {}", value), value != value);
    for (Index c = 0; c < X_.cols() + U_.cols(); ++c) {
      X = X_, U = U_;
      (c < X_.cols() ? X(middle, c) : U(middle, c - X_.cols())) = value;
      const bool state = c < X_.cols();
      compare(X, U, {middle}, fmt::format("{} in {} {}", value, state ? "state" : "action", state ? c : c - X_.cols()),
              false);
    }
  }

  void compare(const Matrix& X, const Matrix& U, const std::vector<Index>& spoilt, const std::string& what,
               bool must_fail) {
    const Matrix dX = change(X, U);
    Matrix expected = whole_;
    for (const Index row : spoilt) {
      expected.row(row) = dX.row(row);
      if (must_fail && dX.row(row).allFinite()) found_.add(fmt::format("{} are answered with numbers", what));
    }
    found_.require(same(dX, expected), fmt::format("{} disturb other rows", what));
  }

  const system::Simulator& simulator_;
  Matrix X_, U_;
  Vector phi_;
  Matrix whole_;
  Violations found_;
};

}  // namespace

std::vector<std::string> check_simulator(const system::Simulator& simulator, const ConstMatrixView& X,
                                         const ConstMatrixView& U, const Vector& phi) {
  Violations sizes;
  const Index parameters = simulator.parameters().size();
  sizes.require(phi.size() == parameters, fmt::format("phi has {} values, must be {}", phi.size(), parameters));
  sizes.require(X.rows() >= 2 && X.rows() == U.rows(),
                fmt::format("the sample has {} states and {} actions, must be as many, ≥ 2", X.rows(), U.rows()));
  if (!sizes.empty()) return sizes.list();
  return SimulatorCheck(simulator, X, U, phi).run();
}

}  // namespace rehearse::testing
