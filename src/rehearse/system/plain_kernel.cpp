#include "rehearse/system/plain_kernel.hpp"

#include <array>

#include <fmt/format.h>

#include "rehearse/core/dormand_prince.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::system {
namespace {

/// One row at a time; its vectors are made once a batch.
class Row {
 public:
  Row(const Ode& ode, const OdeSizes& sizes, const double* phi)
      : ode_(ode), states_(sizes.states), u_(sizes.actions), phi_(Vector::Map(phi, sizes.parameters)) {}

  Vector& state() { return x_; }
  Vector& action() { return u_; }

  const Vector& slope() {
    evaluate(x_, 0);
    return slopes_[0];
  }

  void step(double h) {
    using namespace dormand_prince;
    evaluate(x_, 0);
    evaluate(ahead(kStage2, h), 1);
    evaluate(ahead(kStage3, h), 2);
    evaluate(ahead(kStage4, h), 3);
    evaluate(ahead(kStage5, h), 4);
    evaluate(ahead(kStage6, h), 5);
    x_ = ahead(kEnd, h);
  }

 private:
  void evaluate(const Vector& x, std::size_t stage) {
    Vector& slope = slopes_[stage];
    slope.setZero(states_);
    ode_(x, u_, phi_, slope);
    if (slope.size() != states_)
      throw InvalidInput(
          fmt::format("dxdt has {} entries, must have one for each of {} states", slope.size(), states_));
  }

  template <std::size_t Stages>
  const Vector& ahead(const double (&weights)[Stages], double h) {
    y_ = x_;
    for (std::size_t j = 0; j < Stages; ++j) y_ += h * weights[j] * slopes_[j];
    return y_;
  }

  const Ode& ode_;
  Index states_;
  Vector x_, y_, u_, phi_;
  std::array<Vector, 6> slopes_;
};

}  // namespace

OdeKernel plain_kernel(const Ode& ode, const OdeSizes& sizes) {
  const auto derivative = [ode, sizes](const double* x, const double* u, const double* phi, double* dxdt) {
    Row row(ode, sizes, phi);
    row.state() = Vector::Map(x, sizes.states);
    row.action() = Vector::Map(u, sizes.actions);
    Vector::Map(dxdt, sizes.states) = row.slope();
  };
  const auto change = [ode, sizes](const ConstMatrixView& X, const ConstMatrixView& U, const double* phi,
                                   double duration_s, Index steps, MatrixView dX) {
    Row row(ode, sizes, phi);
    for (Index i = 0; i < X.rows(); ++i) {
      row.state() = X.row(i).transpose();
      row.action() = U.row(i).transpose();
      for (Index s = 0; s < steps; ++s) row.step(duration_s / static_cast<double>(steps));
      dX.row(i) = row.state().transpose() - X.row(i);
    }
  };
  return {.states = sizes.states,
          .actions = sizes.actions,
          .parameters = sizes.parameters,
          .derivative = derivative,
          .change = change};
}

std::shared_ptr<const Simulator> make_ode_simulator(Ode ode, ParameterSpace parameters, double dt_s, Index substeps) {
  const auto change = [=](const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) {
    plain_kernel(ode, {X.cols(), U.cols(), phi.size()}).change(X, U, phi.data(), dt_s, substeps, dX);
  };
  return make_simulator(std::move(parameters), change);
}

}  // namespace rehearse::system
