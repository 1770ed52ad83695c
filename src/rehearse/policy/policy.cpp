#include "rehearse/policy/policy.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::policy {

void check_sizes(const Policy& policy, Index states, const ConstMatrixView& Theta, const ConstMatrixView& X,
                 const ConstMatrixView& U) {
  const Index n = X.rows(), P = policy.parameters(), du = policy.actions();
  const bool right_states = states < 0 || X.cols() == states;
  if (right_states && Theta.rows() == n && U.rows() == n && Theta.cols() == P && U.cols() == du) return;
  Violations violations;
  violations.require(right_states, fmt::format("states are {} × {}, must have {} columns", n, X.cols(), states));
  violations.require(Theta.rows() == n && Theta.cols() == P,
                     fmt::format("theta is {} × {}, must be {} × {}", Theta.rows(), Theta.cols(), n, P));
  violations.require(U.rows() == n && U.cols() == du,
                     fmt::format("actions are {} × {}, must be {} × {}", U.rows(), U.cols(), n, du));
  violations.throw_if_any();
}

}  // namespace rehearse::policy
