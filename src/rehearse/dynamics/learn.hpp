#pragma once
// From a data set (and a prior) to a dynamics model: the four kinds that Chatzilygeroudis 2018 compares.

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/feature_map.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/gp/fit.hpp"
#include "rehearse/optim/derivative_free.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::dynamics {

struct GpOptions {
  gp::FitOptions fit;
  PredictedVariance variance = PredictedVariance::latent;
  double tolerance = 0.01;  // error allowed to predictions, as a fraction of σ_n (gp::Posterior); 0: none
  void fields(FieldVisitor& v) {
    v.group("fit", fit);
    v.number("tolerance", tolerance, between(0, 1));
    v.choice("variance", variance, {"latent", "noisy"});
  }
};

/// How the outputs' likelihoods make one score of a φ (Chatzilygeroudis 2018, section IV-B).
enum class Score { sum, product, harmonic };

/// GPs with zero mean: Black-DROPS (Chatzilygeroudis 2017).
struct ZeroMean {
  GpOptions gp;
  ZeroMean() { gp.fit.penalties.length = gp.fit.penalties.snr = true; }  // the authors' code, without a prior only
  void fields(FieldVisitor& v) { v.group("gp", gp); }
};

/// GPs whose mean is the prior as given: Black-DROPS with priors.
struct FixedPrior {
  GpOptions gp;
  void fields(FieldVisitor& v) { v.group("gp", gp); }
};

/// The prior's parameters alone, by the squared one-step error; variance 0.
struct Mi {
  // The authors' code: 2000 evaluations, tolerances 1e-6, not repeated.
  optim::SubplexOptions subplex{.max_evaluations = 4000, .x_tolerance = 1e-6, .value_tolerance = 1e-6, .repeat = true};
  void fields(FieldVisitor& v) { v.group("subplex", subplex); }
};

/// The prior's parameters and the GPs' kernels learned together (Chatzilygeroudis 2018, Algorithm 2).
struct GpMi {
  GpOptions gp;
  Score score = Score::sum;
  optim::SubplexOptions subplex;
  bool least_squares_start = true;  // start from MI's φ where its score is better than that of the last φ: along
                                    // valleys of the score (m up, l down) the local search alone stops far from the end
  Mi least_squares;
  GpMi() { gp.fit.method = gp::FitMethod::lbfgs; }  // as good as Rprop here, with a third of the evaluations
  void fields(FieldVisitor& v) {
    v.group("gp", gp);
    v.choice("score", score, {"sum", "product", "harmonic"});
    v.group("subplex", subplex);
    v.boolean("least_squares_start", least_squares_start);
    v.group("least_squares", least_squares);
  }
};

using Kind = std::variant<ZeroMean, FixedPrior, GpMi, Mi>;

/// Where learning starts; what `learn` returned the time before.
struct WarmStart {
  std::vector<gp::Hyperparameters> kernels;  // one an output; empty: from the data
  std::optional<Vector> phi;                 // of the prior; empty: its own values
};

struct Learned {
  std::shared_ptr<const DynamicsModel> model;
  WarmStart state;                     // kernels and φ found
  std::optional<double> log_evidence;  // of all outputs together, nats; none without GPs
  Index left_out_rows = 0;             // rows whose prior mean was not finite
  Index evaluations = 0;               // of φ
  std::vector<std::string> notes;      // numerical failures survived
};

/// Throws InvalidInput if the kind needs a prior and none is given, or the data set has no usable row.
Learned learn(const Dataset& data, const FeatureMap& features, const prior::Prior* prior, const Kind& kind,
              const WarmStart& start, const Evaluator& evaluator);

/// log of the sum (product, harmonic mean) of likelihoods given as log likelihoods, without over- or underflow.
double score_of(const Vector& log_likelihoods, Score score);

}  // namespace rehearse::dynamics
