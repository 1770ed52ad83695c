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
#include "rehearse/dynamics/least_squares.hpp"
#include "rehearse/dynamics/phi_posterior.hpp"
#include "rehearse/dynamics/score.hpp"
#include "rehearse/gp/fit.hpp"
#include "rehearse/optim/derivative_free.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::dynamics {

struct GpOptions {
  gp::FitOptions fit;
  PredictedVariance variance = PredictedVariance::latent;
  bool joint_angles = true;      // inputs have those that the task names too
  bool integrate_rates = false;  // positions follow from their rates, GPs learn what is left (integration.hpp)
  bool smooth = false;      // noisy states are smoothed where that makes what was measured likelier (smoothing.hpp); φ
                            // moves with them where the score is the product and the search alternating
  double tolerance = 0.01;  // error allowed to predictions, as a fraction of σ_n (gp::Posterior); 0: none
  void fields(FieldVisitor& v) {
    v.group("fit", fit);
    v.boolean("trend", fit.trend, published(false));
    v.boolean("joint_angles", joint_angles, published(false));
    v.boolean("integrate_rates", integrate_rates, published(false));
    v.boolean("smooth", smooth, published(false));
    v.number("tolerance", tolerance, between(0, 1), published(0));
    v.choice("variance", variance, {"latent", "noisy"});
  }
};

/// GPs with zero mean: Black-DROPS (Chatzilygeroudis 2017).
struct ZeroMean {
  GpOptions gp;
  ZeroMean() {
    gp.fit.penalties.length = gp.fit.penalties.snr = true;  // the authors' code, without a prior only
    gp.integrate_rates = true;
  }
  void fields(FieldVisitor& v) { v.group("gp", gp); }
};

/// Of GPs around a prior.
struct ResidualGpOptions : GpOptions {
  bool midpoint = true;  // inputs are those halfway along the step that the prior predicts (Mean)
  bool servos = true;    // where servos get to is learned before the prior is asked what follows (servos.hpp)
  ResidualGpOptions() {
    fit.trend = smooth = true;
    fit.penalties.length_deviation = 1;  // or white noise is taken for a function, of which there would be doubts
  }
  void fields(FieldVisitor& v) {
    GpOptions::fields(v);
    v.boolean("midpoint", midpoint, published(false));
    v.boolean("servos", servos, published(false));
  }
};

/// GPs whose mean is the prior as given: Black-DROPS with priors.
struct FixedPrior {
  ResidualGpOptions gp;
  void fields(FieldVisitor& v) { v.group("gp", gp); }
};

/// The prior's parameters alone, by the squared one-step error; variance 0.
struct Mi : LeastSquares {
  PhiPosteriorOptions posterior;
  Mi() { posterior.misfit_observations = 1; }  // φ takes more of the misfit upon it where no GP does
  void fields(FieldVisitor& v) {
    LeastSquares::fields(v);
    v.group("posterior", posterior);
  }
};

/// How GP-MI looks for the φ of the highest score.
enum class PhiSearch {
  alternating,  // φ with the kernels held and kernels with φ held, by turns (alternating.hpp)
  nested,       // Subplex, each φ with kernels fitted anew (Chatzilygeroudis 2018, Algorithm 2)
};

/// The prior's parameters and the GPs' kernels learned together (Chatzilygeroudis 2018).
struct GpMi {
  ResidualGpOptions gp;
  Score score = Score::product;
  PhiSearch search = PhiSearch::alternating;
  optim::SubplexOptions subplex;    // of the nested search
  bool least_squares_start = true;  // start from MI's φ too: along valleys of the score (m up, l down) a local search
                                    // alone stops far from the end
  LeastSquares least_squares;
  PhiPosteriorOptions posterior;
  GpMi() { gp.fit.starts = 1, gp.fit.part_rows = 0; }  // the alternating search tries other kernels itself
  void fields(FieldVisitor& v) {
    v.group("gp", gp);
    v.choice("score", score, {"sum", "product", "harmonic"}, published("sum"));
    v.choice("search", search, {"alternating", "nested"}, published("nested"));
    v.group("subplex", subplex);
    v.boolean("least_squares_start", least_squares_start, published(false));
    v.group("least_squares", least_squares);
    v.group("posterior", posterior);
  }
};

using Kind = std::variant<ZeroMean, FixedPrior, GpMi, Mi>;

/// Where learning starts; what `learn` returned the time before.
struct WarmStart {
  std::vector<gp::Hyperparameters> kernels;  // one an output; empty: from the data
  std::optional<Vector> phi;                 // of the prior; empty: its own values
};

/// What GPs learned from instead of the data set.
struct SmoothedRows {
  Dataset data;
  std::vector<gp::Hyperparameters> kernels;  // one an output
};

struct Learned {
  std::shared_ptr<const DynamicsModel> model;
  WarmStart state;                        // kernels and φ found
  std::optional<double> log_evidence;     // of all outputs together, nats; none without GPs
  std::optional<double> score;            // GP-MI's, nats
  std::optional<PhiPosterior> posterior;  // of GP-MI and MI
  std::optional<SmoothedRows> smoothed;   // where states were smoothed
  Index left_out_rows = 0;                // rows whose prior mean was not finite
  Index evaluations = 0;                  // of φ
  std::vector<std::string> notes;         // numerical failures survived
};

/// Throws InvalidInput if the kind needs a prior and none is given, or the data set has no usable row.
Learned learn(const Dataset& data, const FeatureMap& features, const Kinematics& kinematics, const prior::Prior* prior,
              const Kind& kind, const WarmStart& start, const Evaluator& evaluator);

}  // namespace rehearse::dynamics
