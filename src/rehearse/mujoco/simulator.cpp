#include "rehearse/mujoco/simulator.hpp"

#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/names.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/mujoco/instance.hpp"

namespace rehearse::mujoco {
namespace {

/// The place in φ of each of the description's parameters.
std::vector<Index> order_of(const std::vector<std::string>& names, const ParameterSpace& parameters) {
  std::vector<Index> order;
  Violations violations;
  for (const std::string& name : names) {
    order.push_back(parameters.find(name));
    violations.require(order.back() >= 0, fmt::format("parameter '{}' of the model is missing", name));
  }
  for (const std::string& name : parameters.names())
    violations.require(is_among(name, names),
                       names.empty() ? fmt::format("unknown parameter '{}': the model has none", name)
                                     : fmt::format("unknown parameter '{}'{}", name, suggestions(name, names)));
  violations.throw_if_any();
  return order;
}

class ModelSimulator final : public system::Simulator {
 public:
  ModelSimulator(SharedModel compiled, ParameterSpace parameters, std::vector<Index> order)
      : instances_(std::move(compiled)), parameters_(std::move(parameters)), order_(std::move(order)) {}

  const ParameterSpace& parameters() const override { return parameters_; }

  void change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const override {
    check_sizes(*this, X, U, phi, dX);
    require_columns(X.cols(), U.cols());
    std::unique_ptr<Instance> instance = instances_.take(phi(order_));
    Vector x(X.cols()), u(U.cols());
    for (Index i = 0; i < X.rows(); ++i) {
      x = X.row(i);
      u = U.row(i);
      instance->place(x);
      if (instance->step(u))
        instance->read(x);
      else
        x.setConstant(kNaN);
      dX.row(i) = x.transpose() - X.row(i);
    }
    instances_.give_back(std::move(instance));
  }

 private:
  void require_columns(Index dx, Index du) const {
    const Index states = instances_.compiled().states().size(), actions = instances_.compiled().actions();
    if (dx == states && du == actions) return;
    throw InvalidInput(
        fmt::format("{} states and {} actions for a model of {} states and {} actions", dx, du, states, actions));
  }

  Instances instances_;
  ParameterSpace parameters_;
  std::vector<Index> order_;
};

}  // namespace

std::shared_ptr<const system::Simulator> make_simulator(SharedModel model, ParameterSpace parameters) {
  std::vector<Index> order = order_of(model->parameter_names(), parameters);
  return std::make_shared<ModelSimulator>(std::move(model), std::move(parameters), std::move(order));
}

Warnings warnings_of(const SharedModel& model, const std::vector<Interval>& bounds, const Vector& start) {
  Instance instance(model);
  instance.place(start);
  return {model->unseen(), model->misfits(bounds, instance.data())};
}

}  // namespace rehearse::mujoco
