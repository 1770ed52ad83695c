#pragma once
// Few training points that stand for all of them: where the learned noise hides what they leave unexplained, a
// posterior over them predicts the same with a fraction of the work.

#include <optional>
#include <vector>

#include "rehearse/core/types.hpp"
#include "rehearse/gp/inputs.hpp"

namespace rehearse::gp {

/// r of the n points, chosen by pivoted Cholesky, with targets and a noise covariance that carry what all n targets
/// say about them. With C ≈ T C_PP Tᵀ, T = C_·P C_PP⁻¹, conditioning on y + noise of variance ρ is conditioning on
/// (TᵀT)⁻¹Tᵀ y with noise ρ (TᵀT)⁻¹ at the pivots: the DTC posterior of Quiñonero-Candela 2005, without its inversion
/// of C_PP, so that it is as well conditioned as the exact posterior.
struct Summary {
  std::vector<Index> points;  // r
  Matrix covariance;          // r × r, C_PP + ρ (TᵀT)⁻¹, lower triangle
  Vector targets;             // r
  double mean_error = 0;      // bound of |difference| from the exact posterior mean, where s̃ ≤ 1; elsewhere × s̃
};

/// C: n × n covariances over σ_f² (lower triangle), with a trend or without; ρ = σ_n²/σ_f²; weights w = (C + ρI)⁻¹ y.
/// The points leave a remainder R = C − T C_PP Tᵀ of trace at most tρ. Then at any input, where s̃ is the standard
/// deviation of the summary and s that of all points in units of σ_f,
///
///   |s − s̃| ≤ (t + √t) s̃,   |m − m̃| ≤ √(wᵀRw) (1 + √t) s̃:
///
/// R acts as a further noise between 0 and tρ whose correlation with the rest is √t at most. With ã the weights of the
/// targets in m̃, ρ‖ã‖² and the variance that the points leave of f(x) are both s̃² at most. Without a trend s̃ ≤ 1; with
/// one s̃ grows without end away from the data, and so do the errors. None if more than `most` points are needed, or a
/// factorisation fails.
std::optional<Summary> summarise(const Matrix& C, double noise_ratio, const ConstVectorView& y,
                                 const ConstVectorView& weights, double t, Index most);

/// The inputs (4 n × D) at which the errors of few points are measured: the training inputs; points halfway from each
/// to the next, and to one half the data further; and as far beyond it.
Matrix probes(const Inputs& inputs);

}  // namespace rehearse::gp
