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

  /// The interval in which each number of θ must lie; empty: none, and the search chooses one.
  virtual std::optional<Interval> box() const { return std::nullopt; }

  /// Values of θ that are known to do something sensible, one a row; 0 × parameters() if there are none.
  virtual Matrix examples() const { return Matrix(0, parameters()); }

  /// Theta: n × parameters(), one policy a row; X: n × dx; t_s: time since the episode's start; U: n × du, written.
  /// A row with a NaN state gets a NaN action. Throws InvalidInput where sizes are wrong.
  virtual void act(const ConstMatrixView& Theta, const ConstMatrixView& X, double t_s, MatrixView U) const = 0;
};

/// Throws InvalidInput unless the arguments of `act` have the sizes stated there. states: dx; −1: any.
void check_sizes(const Policy& policy, Index states, const ConstMatrixView& Theta, const ConstMatrixView& X,
                 const ConstMatrixView& U);

}  // namespace rehearse::policy
