#pragma once

#include <vector>

#include "rehearse/moments/gaussian.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::moments {

/// The part of the forward pass that the adjoint needs. Points are rows of states, then actions. Reused without
/// allocation; not shared by threads.
struct PriorTape {
  Matrix directions;          // n × n, a column each: from the mean to a point on that side
  Matrix points, changes;     // inputs and outputs of the prior
  Matrix neighbours, nearby;  // the same of the points that derivatives of the answers need (`differentiate`)
};

/// The moments of the change that a prior predicts, where states and actions together are Gaussian, n variables; with
/// their adjoint, by batches of differences. Use it where a simulator is the mean of GPs (PI-REM). Immutable; any
/// thread.
class PriorMoments {
 public:
  virtual ~PriorMoments() = default;

  Index states() const { return states_; }    // dx
  Index actions() const { return actions_; }  // du
  Index inputs() const { return states_ + actions_; }

  /// input: of n variables. change: its gain is that of states and actions (n × dx). Calls the prior once. False, and
  /// `change` undefined, where the prior fails at a point, or the input is no Gaussian. Throws InvalidInput on wrong
  /// sizes.
  bool forward(const Gaussian& input, PriorTape& tape, Transformed& change) const;

  /// Calls the prior once, for the predictions that the adjoints of all these steps need. False where it fails at a
  /// point.
  bool differentiate(const std::vector<PriorTape*>& tapes) const;

  /// Adds to the adjoint of the input what the adjoint of the change brings, up to the square of the steps of
  /// differences. `differentiate` comes before.
  void adjoint(const Gaussian& input, const PriorTape& tape, const Transformed& change, const Transformed& adjoint,
               Gaussian& input_adjoint) const;

 protected:
  /// phi: of the prior, fixed.
  PriorMoments(prior::Prior prior, Vector phi, Index states, Index actions)
      : prior_(std::move(prior)), phi_(std::move(phi)), states_(states), actions_(actions) {}

 private:
  /// Writes the tape's points and directions. False if the input is no Gaussian.
  virtual bool place(const Gaussian& input, PriorTape& tape) const = 0;
  /// Mean, gain, and the part of the covariance that does not come with the gain.
  virtual void combine(const PriorTape& tape, Transformed& change) const = 0;
  /// The number of neighbours of a step, and the neighbours (rows × n).
  virtual Index neighbours() const = 0;
  virtual void place_neighbours(const PriorTape& tape, MatrixView neighbours) const = 0;
  /// The adjoint of `combine` and `place`.
  virtual void combine_adjoint(const PriorTape& tape, const Transformed& change, const Transformed& adjoint,
                               Gaussian& input_adjoint) const = 0;

  bool ask(const Matrix& points, Matrix& changes) const;

  prior::Prior prior_;
  Vector phi_;
  Index states_, actions_;
};

}  // namespace rehearse::moments
