#pragma once
// Few training points that stand for all of them: where the learned noise hides what they leave unexplained, a
// posterior over them predicts the same with a fraction of the work.

#include <optional>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::gp {

/// r of the n points, chosen by pivoted Cholesky, with targets and a noise covariance that carry what all n targets
/// say about them. With C ≈ T C_PP Tᵀ, T = C_·P C_PP⁻¹, conditioning on y + noise of variance ρ is conditioning on
/// (TᵀT)⁻¹Tᵀ y with noise ρ (TᵀT)⁻¹ at the pivots: the DTC posterior of Quiñonero-Candela 2005, without its inversion
/// of C_PP, so that it is as well conditioned as the exact posterior.
struct Summary {
  std::vector<Index> points;  // r
  Matrix covariance;          // r × r, C_PP + ρ (TᵀT)⁻¹, lower triangle
  Vector targets;             // r
};

/// C: n × n correlations (lower triangle); ρ = σ_n²/σ_f². The points leave a remainder R = C − T C_PP Tᵀ of trace at
/// most `remainder`. With t = trace(R)/ρ the standard deviation s̃ of the summary and s of all points then differ by
/// at most (t + √t) s̃, in units of σ_f, at any input: R acts as a further noise between 0 and ρt, and correlates with
/// the rest by √t at most. None if more than `most` points are needed, or a factorisation fails.
std::optional<Summary> summarise(const Matrix& C, double noise_ratio, const ConstVectorView& y, double remainder,
                                 Index most);

}  // namespace rehearse::gp
