#pragma once

#include "rehearse/moments/prior_moments.hpp"

namespace rehearse::moments {

/// The prior by its slopes at the mean, which are central differences (2 n + 1 points): the mean of the change is the
/// change at the mean, and covariances go through the slopes (Saveriano 2017, section III). Exact where the prior is
/// linear. The adjoint needs its second derivatives, differences too (n (n − 1) more points).
class LinearisedPrior final : public PriorMoments {
 public:
  LinearisedPrior(prior::Prior prior, Vector phi, Index states, Index actions)
      : PriorMoments(std::move(prior), std::move(phi), states, actions) {}

 private:
  bool place(const Gaussian& input, PriorTape& tape) const override;
  void combine(const PriorTape& tape, Transformed& change) const override;
  Index neighbours() const override { return inputs() * (inputs() - 1); }
  void place_neighbours(const PriorTape& tape, MatrixView neighbours) const override;
  void combine_adjoint(const PriorTape& tape, const Transformed& change, const Transformed& adjoint,
                       Gaussian& input_adjoint) const override;
};

}  // namespace rehearse::moments
