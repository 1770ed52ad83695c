#pragma once

#include <memory>
#include <string>

#include "python/bindings/calls.hpp"
#include "rehearse/policy/exported.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::python {

/// A policy at one θ, to act and to be taken along. Immutable; any thread.
class Policy {
 public:
  Policy(std::shared_ptr<const policy::Policy> policy, policy::Exported exported)
      : policy_(std::move(policy)), exported_(std::move(exported)) {}

  /// states: dx, or n × dx, with the memory of actuators. Actions: du, or n × du; they are commands.
  py::array_t<double> act(const py::array_t<double, py::array::f_style | py::array::forcecast>& states,
                          double time_s) const;

  /// The memory (n × its size) after steps from states (n × dx) under commands (n × du).
  Matrix remember(const Matrix& states, const Matrix& actions) const;

  /// The same at another θ, which nobody has tried yet. Throws InvalidInput where θ is of another size or not finite.
  Policy with_theta(const Vector& theta) const;

  const policy::Exported& exported() const { return exported_; }

 private:
  std::shared_ptr<const policy::Policy> policy_;
  policy::Exported exported_;
};

void add_policy(py::module_& module);

}  // namespace rehearse::python
