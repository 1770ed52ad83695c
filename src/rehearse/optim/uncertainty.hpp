#pragma once
// Uncertainty handling for noisy objectives: UH-CMA-ES of Hansen, Niederberger, Guzzella and Koumoutsakos 2009 (A
// method for handling uncertainty in evolutionary optimization with an application to feedback control of combustion).

#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/core/types.hpp"

namespace rehearse::optim {

/// The defaults are those of Hansen's pycma, who revised the paper's (in brackets). libcmaes never evaluates a
/// candidate more often but widens σ at once: reevaluated = 0.1, reevaluated_least = 2, tolerance = 0.2, smoothing = 1,
/// max_samples = 1.
struct UncertaintyOptions {
  bool enabled = false;
  double reevaluated = 0.3;     // r_λ (0.3): fraction of the candidates that is evaluated twice in a generation
  Index reevaluated_least = 1;  // candidates (libcmaes: 2)
  double tolerance = 0.5;       // θ (0.2): rank changes up to this fraction of those of pure noise are acceptable
  double smoothing = 0.3;       // c_s (1): weight of the newest measurement
  Index max_samples = 30;     // t_max: evaluations of a candidate at most; beyond, σ grows. Ours: with 10, σ diverged
                              // on a sphere times exp(N(0, 1)), with 100 the search was slower
  double samples_growth = 0;  // α_t (1.5): their growth while the noise is too large; 0: 1 + 2 / (n + 10)
  double samples_decay = 0.25;  // (1): their decay when it is not, α_t^(−samples_decay)
  double sigma_growth = 0;      // α_σ; 0: 1 + 2 / (n + 10)
  void fields(FieldVisitor& v);
};

/// Measures by re-evaluation how much the noise changes the ranking of a generation, and how to respond.
class UncertaintyHandler {
 public:
  UncertaintyHandler(const UncertaintyOptions& options, Index dimension, Index population);

  Index samples() const;          // evaluations of each candidate in this generation
  Index reevaluations() const;    // of this generation: its first so many candidates are evaluated twice
  Index generation_cost() const;  // evaluations that this generation takes

  /// Takes the values (λ) of this generation, those of its first `reevaluations()` candidates evaluated again, and the
  /// penalty that the ranking subtracts from each (λ; empty: none). Leaves in `values` the means of both evaluations;
  /// returns the candidates from best to worst by the sum of their ranks in both. What is not finite is the worst.
  std::vector<Index> rank(VectorView values, const ConstVectorView& again, const Vector& penalties = {});

  double sigma_factor() const { return sigma_factor_; }  // that the last generation asks for
  double uncertainty() const { return uncertainty_; }    // s̄; above zero: too much noise

 private:
  void treat();

  UncertaintyOptions options_;
  Index population_;
  double real_samples_ = 1;
  double carried_;  // fraction of a re-evaluation left over for the next generation
  double uncertainty_ = 0;
  double sigma_factor_ = 1;
};

}  // namespace rehearse::optim
