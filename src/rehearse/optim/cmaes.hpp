#pragma once
// One descent of CMA-ES, by `ask` for candidates and `tell` of their values.

#include <string>
#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/types.hpp"
#include "rehearse/optim/box.hpp"
#include "rehearse/optim/covariance.hpp"
#include "rehearse/optim/stop.hpp"
#include "rehearse/optim/strategy_constants.hpp"

namespace rehearse::optim {

/// Defaults of Hansen 2016 (tutorial, arXiv 1604.00772, appendix B.3) and Hansen 2009 (BIPOP).
struct CmaesOptions {
  Index population = 0;  // λ; 0: 4 + ⌊3 ln n⌋
  bool active = true;    // negative weights for the worse half
  bool elitism = false;  // the best point so far is evaluated again in every generation, as another of its candidates
                         // each time; its value is the mean of all its evaluations, so that one lucky draw of a noisy
                         // objective does not stay
  double value_tolerance = 1e-12;  // stop when recent best values and the generation differ by less
  double step_tolerance = 1e-12;   // stop when all steps are below this fraction of the first σ
  double max_condition = 1e14;     // stop when the covariance is conditioned worse
  double max_growth = 1e4;         // stop when σ's largest axis has grown by more
  bool stagnation = true;          // stop when neither best nor median improved over the last 20 % of generations
  Index max_generations = 0;       // 0: 100 + 50 (n + 3)² / √λ
  Index eigen_up_to = 50;          // coordinates; beyond, C's root is its Cholesky factor: it needs at most 3 % more
                                   // evaluations (measured), and the eigendecomposition would take most of the time
  void fields(FieldVisitor& v);
};

/// (μ/μ_w, λ)-CMA-ES with active covariance update (Hansen 2016), maximising. A value; not shared between threads.
class Cmaes {
 public:
  /// Starts at `mean` with step size `sigma`. `box`: one interval a coordinate; empty: unbounded. Generation g draws
  /// from (key, g) alone. Throws InvalidInput with every violation.
  Cmaes(const Vector& mean, double sigma, const std::vector<Interval>& box, const CmaesOptions& options,
        const StreamKey& key);

  /// The candidates of this generation, n × λ, one a column, inside the box; the same until `tell`.
  const Matrix& ask();

  /// Their values (λ). What is not finite is the worst. `order`: the candidates from best to worst, where it is known
  /// better than from the values (uncertainty handling); empty: by value, ties to the first.
  void tell(const ConstVectorView& values, const std::vector<Index>& order = {});

  /// The penalties (λ), to be subtracted from these values, of draws outside the box; `tell` without an order does so.
  const Vector& penalties(const ConstVectorView& values);

  /// Multiplies σ, as uncertainty handling does.
  void widen(double factor) { sigma_ *= factor; }

  Stop stop() const { return stop_; }
  const Vector& best_x() const { return best_x_; }   // n; the start as long as no value was finite
  double best_value() const { return best_value_; }  // −∞ as long as no value was finite
  Vector mean() const;                               // n, inside the box
  double sigma() const { return sigma_; }
  Index evaluations() const { return evaluations_; }
  Index generation() const { return generation_; }
  Index population() const { return constants_.weights.size(); }
  Index dimension() const { return mean_.size(); }

 private:
  static constexpr Index kNone = -1;
  void draw();
  void place_elite();
  void rank(const ConstVectorView& values);
  Vector deviations() const;
  void keep_best(const ConstVectorView& values);
  void move_mean();
  void adapt_step();
  void adapt_covariance();
  void renew_decomposition();
  void keep_inside();
  void record(const ConstVectorView& values);
  Stop find_stop(const ConstVectorView& values) const;
  bool values_settled(const ConstVectorView& values) const;
  bool stagnated() const;
  bool steps_vanished() const;
  bool without_effect() const;

  CmaesOptions options_;
  StreamKey key_;
  Box box_;
  StrategyConstants constants_;
  Covariance covariance_;
  Vector mean_;  // may leave the box a little
  Vector path_sigma_, path_c_, step_, whitened_;
  Matrix normals_;            // λ × n
  Matrix steps_;              // n × λ, (x_i − mean) / σ
  Matrix ranked_;             // n × (λ + 1): weighted steps, best first, and the path
  Matrix draws_;              // n × λ
  Matrix candidates_;         // n × λ, the draws projected onto the box
  std::vector<Index> order_;  // best first
  Index elite_ = kNone;       // the candidate of this generation that is the best point so far
  bool asked_ = false;
  bool path_stalled_ = false;
  double sigma_, first_sigma_;
  Vector best_x_;
  double best_value_;
  Index best_count_ = 0;  // evaluations that best_value_ is the mean of
  Index evaluations_ = 0, generation_ = 0, decomposed_ = 0;
  std::vector<double> best_history_, median_history_;
  Stop stop_ = Stop::none;
};

}  // namespace rehearse::optim
