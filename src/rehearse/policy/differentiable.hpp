#pragma once

#include <vector>

#include "rehearse/policy/policy.hpp"

namespace rehearse::policy {

/// A policy with derivatives of its actions, which a search by gradient needs. A Policy of one's own implements it,
/// too, to be searched so. Any thread.
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
