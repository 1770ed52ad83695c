#pragma once

#include "rehearse/moments/prior_moments.hpp"

namespace rehearse::moments {

/// The prior at 2 n points μ ± √n B_k, where B Bᵀ is the covariance and the squares of the steps of differences, so
/// that points never coincide: without covariance this is the linearised prior. Their weights are equal, as in
/// Arasaratnam 2009 (the cubature rule), so that covariances are positive semi-definite. The differences between the
/// two sides of the mean give the gain, their sums the mean and the rest of the covariance. Exact where the prior is
/// linear. The adjoint needs its slopes at all points (4 n² more points).
class UnscentedPrior final : public PriorMoments {
 public:
  UnscentedPrior(prior::Prior prior, Vector phi, Index states, Index actions)
      : PriorMoments(std::move(prior), std::move(phi), states, actions) {}

 private:
  bool place(const Gaussian& input, PriorTape& tape) const override;
  void combine(const PriorTape& tape, Transformed& change) const override;
  Index neighbours() const override { return 4 * inputs() * inputs(); }
  void place_neighbours(const PriorTape& tape, MatrixView neighbours) const override;
  void combine_adjoint(const PriorTape& tape, const Transformed& change, const Transformed& adjoint,
                       Gaussian& input_adjoint) const override;
};

}  // namespace rehearse::moments
