#pragma once

#include <optional>
#include <string>

#include "rehearse/core/types.hpp"

namespace rehearse::policy {

/// Deterministic u = π(x; θ), u inside its bounds for every θ and x. Immutable; any thread.
///
/// A batch may hold a different θ in each row: candidates are compared in lockstep.
class Policy {
 public:
  virtual ~Policy() = default;

  virtual std::string name() const = 0;  // "mlp"
  virtual Index parameters() const = 0;  // of θ
  virtual Index actions() const = 0;     // du

  /// Where each number of θ must lie; empty: anywhere, and whoever searches says where.
  virtual std::optional<Interval> box() const { return std::nullopt; }

  /// Each row a θ that is known to do something sensible, where there are any: 0 × parameters() or more.
  virtual Matrix examples() const { return Matrix(0, parameters()); }

  /// Theta: n × parameters(), one policy a row; X: n × dx; t_s: time since the episode's start; U: n × du, written.
  /// A row with a NaN state gets a NaN action. Throws InvalidInput where sizes are wrong.
  virtual void act(const ConstMatrixView& Theta, const ConstMatrixView& X, double t_s, MatrixView U) const = 0;
};

/// Throws InvalidInput unless what `act` was given has the sizes that it says. states: dx; −1: any.
void check_sizes(const Policy& policy, Index states, const ConstMatrixView& Theta, const ConstMatrixView& X,
                 const ConstMatrixView& U);

}  // namespace rehearse::policy
