#pragma once

#include <vector>

#include "rehearse/gp/posterior.hpp"

namespace rehearse::moments {

/// A network of radial basis functions that adds to one output, with the uncertainty of the GP whose mean it is or
/// without, c the correlation exp(−½ Σ_d (x_d − x_id)² / ℓ_d²):
///
///   mean f(x) = Σ_i w_i c(x, x_i),   var f(x) = σ_f² − Σ_ij N_ij c(x, x_i) c(x, x_j)
struct MomentTerm {
  Index output = 0;
  Matrix centres;       // n × D
  Vector log_lengths;   // D
  Vector weights;       // n; of a GP σ_f² (K + σ_n² I)⁻¹ y
  double variance = 0;  // σ_f², or what is added to the output's variance where there is no N
  Matrix reduction;     // N: n × n, symmetric; of a GP σ_f⁴ (K + σ_n² I)⁻¹; empty: none
  Matrix factor = {};   // F: n × n with N = Fᵀ F, or empty: where it is known, variances at narrow inputs use it

  Index size() const { return centres.rows(); }
  Index inputs() const { return centres.cols(); }
};

/// The GPs of a posterior, exactly: n × n numbers an output. The posterior must have been made without tolerance.
std::vector<MomentTerm> exact_terms(const gp::Posterior& posterior);

/// The means of GPs alone, without the uncertainty of the functions: the mean functions of other GPs (Cutler 2015).
std::vector<MomentTerm> mean_terms(std::vector<MomentTerm> terms);

/// The means f(x) (n × outputs) at inputs X (n × D); a row depends on that row alone. Any thread.
Matrix evaluate_means(const std::vector<MomentTerm>& terms, Index outputs, const ConstMatrixView& X);

/// Throws InvalidInput unless the terms fit each other and so many outputs. parameters: those that have adjoints of
/// their own are wanted.
void require_terms(const std::vector<MomentTerm>& terms, Index outputs, bool parameters);

}  // namespace rehearse::moments
