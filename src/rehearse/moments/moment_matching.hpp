#pragma once
// The moments of GPs and radial basis functions of a Gaussian input, in closed form (Deisenroth 2010, section 2.3;
// Quiñonero-Candela 2003), and their adjoint.

#include <vector>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/moments/gaussian.hpp"
#include "rehearse/moments/moment_kernel.hpp"
#include "rehearse/moments/moment_term.hpp"

namespace rehearse::moments {

/// The part of the forward pass that the adjoint needs. Reused from call to call without allocation; not shared by
/// threads.
struct MomentTape {
  std::vector<Matrix> points;   // distinct centres less the mean of the input, stride × D
  std::vector<Vector> kernels;  // a term: E[c(x, x_i)], stride
  Matrix means, gains;          // a term: its mean; D × terms
  Matrix pairs;                 // a pair of terms: E[f g], its derivatives by m and s: a column of 1 + D + D²
  Vector covariances;           // a pair of terms under a narrow input: cov[f, g], less σ_f²; else NaN
  Matrix sums;                  // with parameters, a pair: PairSums' second of a and b, cross: a column of 3 D²
  std::vector<Matrix> rows;     // with parameters: PairSums' of a pair and of its mirror image
  std::vector<char> ok;         // of what runs in parallel
};

/// The adjoint of a term: of centres, ln ℓ and weights.
struct TermAdjoint {
  Matrix centres;      // n × D
  Vector log_lengths;  // D
  Vector weights;      // n
};

struct PairGeometry;  // moment_geometry.hpp

/// Outputs that are sums of terms. Terms with reduction are independent functions. Immutable; any thread.
class MomentMatching {
 public:
  /// parameters: true if `adjoint` will be called for the terms' adjoints; only without reductions. Throws InvalidInput
  /// on sizes that do not agree, numbers that are not finite, or more than kMostMomentInputs inputs.
  MomentMatching(std::vector<MomentTerm> terms, Index outputs, bool parameters = false);
  MomentMatching(MomentMatching&&) = default;
  MomentMatching& operator=(MomentMatching&&) = default;

  Index inputs() const { return inputs_; }
  Index outputs() const { return outputs_; }
  const std::vector<MomentTerm>& terms() const { return terms_; }

  /// Throws InvalidInput on wrong sizes. False, and `result` undefined, if the input is not a Gaussian (not finite, or
  /// its covariance far from positive semi-definite). The covariance of the result has the uncertainty of the
  /// functions, no measurement noise. Its sums over pairs of points cancel: rounding leaves
  /// some 1e-14 of ‖N‖ or ‖w‖² (moment_term.hpp), 1e-8 σ_f² where σ_f = 100 σ_n and far more at the limit of fits,
  /// which may make a variance negative. Not so under an input so narrow that this would matter most
  /// (moment_narrow.hpp): of exact GPs the variance is that of the prediction at no input covariance, and never
  /// negative. Inducing inputs have no such way; their ridge bounds the rounding. The pairs of terms are spread over
  /// the evaluator's threads where that is worth it; the result is the same for any number.
  bool forward(const Gaussian& input, MomentTape& tape, Transformed& result,
               const Evaluator& evaluator = serial_evaluator()) const;

  /// Adds to the adjoint of the input, and to those of the terms unless null, what the adjoint of the result brings.
  void adjoint(const Gaussian& input, const MomentTape& tape, const Transformed& result, const Transformed& adjoint,
               Gaussian& input_adjoint, std::vector<TermAdjoint>* terms = nullptr) const;

  std::vector<TermAdjoint> zero_adjoints() const;

 private:
  struct Pair {
    Index a, b;
  };

  const MomentTerm& term(Index a) const { return terms_[static_cast<std::size_t>(a)]; }
  WeightedPoints weighted(Index a, const MomentTape& tape, const double* weights) const;
  const double* weights(Index a) const { return weights_[static_cast<std::size_t>(a)].data(); }
  void check(const Gaussian& input) const;
  void prepare(const Gaussian& input, MomentTape& tape) const;
  bool mean(const Gaussian& input, Index a, MomentTape& tape) const;
  bool pair(const Gaussian& input, Index p, MomentTape& tape) const;
  bool narrow_pair(const Gaussian& input, Index p, const PairGeometry& g, MomentTape& tape) const;
  void keep(Index p, const PairGeometry& g, double total, const PairSums& sums, MomentTape& tape) const;
  bool combine(const MomentTape& tape, Transformed& result) const;
  void mean_adjoint(const Gaussian& input, const MomentTape& tape, Index a, double by_mean,
                    const ConstVectorView& by_gain, Gaussian& input_adjoint, TermAdjoint* term) const;
  void pair_adjoint(const Gaussian& input, const MomentTape& tape, Index p, double by,
                    std::vector<TermAdjoint>& terms) const;

  std::vector<MomentTerm> terms_;
  Index inputs_ = 0, outputs_ = 0;
  bool parameters_;
  double work_ = 0;  // kernel values of a call
  std::vector<Pair> pairs_;
  std::vector<double> narrow_limits_;   // a pair: narrow_limit()
  std::vector<const Matrix*> centres_;  // distinct
  std::vector<Index> centres_of_;       // a term: where its own are
  std::vector<Vector> weights_;         // a term, padded
  std::vector<Matrix> pair_weights_;    // of terms with reduction, of w wᵀ − N
};

}  // namespace rehearse::moments
