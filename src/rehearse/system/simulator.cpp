#include "rehearse/system/simulator.hpp"

#include <cmath>
#include <new>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::system {
namespace {

/// The largest state change; beyond it a simulator has diverged.
constexpr double kLargestChange = 1e12;

bool is_usable(const MatrixView& dX, Index row) {
  bool usable = true;
  for (Index c = 0; c < dX.cols(); ++c) usable = usable && std::abs(dX(row, c)) < kLargestChange;  // false for NaN
  return usable;
}

/// The reason why a row alone fails, which it writes; Unavailable and std::bad_alloc go on.
std::string change_row(const Simulator& simulator, const ConstMatrixView& x, const ConstMatrixView& u,
                       const Vector& phi, MatrixView dx) {
  std::string why = "it threw something that says nothing";
  try {
    simulator.change(x, u, phi, dx);
    return {};
  } catch (const Unavailable&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    why = error.what();
  } catch (...) {
  }
  dx.setConstant(kNaN);
  return why;
}

class FunctionSimulator final : public Simulator {
 public:
  FunctionSimulator(ParameterSpace parameters, Change change, Index rows_at_once)
      : parameters_(std::move(parameters)), change_(std::move(change)), rows_at_once_(rows_at_once) {}

  const ParameterSpace& parameters() const override { return parameters_; }
  void change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const override {
    check_sizes(*this, X, U, phi, dX);
    change_(X, U, phi, dX);
  }
  Index rows_at_once() const override { return rows_at_once_; }

 private:
  ParameterSpace parameters_;
  Change change_;
  Index rows_at_once_;
};

}  // namespace

void check_sizes(const Simulator& simulator, const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi,
                 const ConstMatrixView& dX) {
  const Index parameters = simulator.parameters().size();
  if (U.rows() == X.rows() && dX.rows() == X.rows() && dX.cols() == X.cols() && phi.size() >= parameters) return;
  throw InvalidInput(fmt::format(
      "a simulator of {} parameters was given states {} × {}, actions {} × {}, phi of {} and changes {} × {}; rows, "
      "states and parameters must agree",
      parameters, X.rows(), X.cols(), U.rows(), U.cols(), phi.size(), dX.rows(), dX.cols()));
}

std::shared_ptr<const Simulator> make_simulator(ParameterSpace parameters, Change change, Index rows_at_once) {
  return std::make_shared<FunctionSimulator>(std::move(parameters), std::move(change), rows_at_once);
}

Index change_contained(const Simulator& simulator, const ConstMatrixView& X, const ConstMatrixView& U,
                       const Vector& phi, MatrixView dX, FirstFault* fault) {
  check_sizes(simulator, X, U, phi, dX);
  bool one_by_one = false;
  try {
    simulator.change(X, U, phi, dX);
  } catch (const Unavailable&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {
    one_by_one = true;
  }
  Index failed = 0;
  for (Index i = 0; i < X.rows(); ++i) {
    std::string why;
    if (one_by_one) why = change_row(simulator, X.middleRows(i, 1), U.middleRows(i, 1), phi, dX.middleRows(i, 1));
    if (is_usable(dX, i)) continue;
    dX.row(i).setConstant(kNaN);
    ++failed;
    if (fault) fault->add(X.row(i).transpose(), U.row(i).transpose(), why);
  }
  return failed;
}

}  // namespace rehearse::system
