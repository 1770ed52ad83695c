#pragma once

#include <vector>

#include "rehearse/policy/policy.hpp"

namespace rehearse::policy {

/// A policy that knows the derivatives of its actions, which a search by gradient asks for. A Policy of one's own that
/// is to be searched so implements it, too. Any thread.
class Differentiable {
 public:
  virtual ~Differentiable() = default;

  /// The chain rule, for rows that share θ (parameters()). X: n × dx; by_actions (n × du): derivatives of some number
  /// by the actions that `act` gives each row. by_states (n × dx) receives its derivatives by the states, and those by
  /// θ, summed over the rows in order, are added to by_theta. Sizes are the caller's to get right.
  virtual void pull_back(const ConstVectorView& theta, const ConstMatrixView& X, const ConstMatrixView& by_actions,
                         MatrixView by_states, VectorView by_theta) const = 0;

  /// Numbers of θ by which units count in the actions: without some of them it is a policy of fewer units (dropout).
  virtual std::vector<Index> unit_weights() const { return {}; }
};

}  // namespace rehearse::policy
