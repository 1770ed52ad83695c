#pragma once
// The four kinds of dynamics models that Chatzilygeroudis 2018 compares, and how each is learned.

#include <variant>

#include "rehearse/core/options.hpp"
#include "rehearse/dynamics/gp_options.hpp"
#include "rehearse/identification/least_squares.hpp"
#include "rehearse/identification/phi_posterior.hpp"
#include "rehearse/identification/score.hpp"
#include "rehearse/optim/derivative_free.hpp"

namespace rehearse::identification {

using dynamics::GpOptions;

/// GPs with zero mean: Black-DROPS (Chatzilygeroudis 2017).
struct ZeroMean {
  GpOptions gp;
  ZeroMean() {
    gp.fit.penalties.length = gp.fit.penalties.snr = true;  // the authors' code, without a prior only
    gp.integrate_rates = true;
    gp.fit.trend = true;
    gp.mirror = dynamics::Mirror::automatic;
  }
  void fields(FieldVisitor& v) { v.group("gp", gp); }
};

/// Options of GPs around a prior.
struct ResidualGpOptions : GpOptions {
  bool servos = true;  // GPs learn the positions that servos reach, the prior predicts what follows (servos.hpp)
  ResidualGpOptions() {
    fit.trend = smooth = midpoint = true;
    fit.penalties.length_deviation =
        1;  // or white noise is taken for a function, of which the model would be uncertain
  }
  void fields(FieldVisitor& v) {
    GpOptions::fields(v);
    v.boolean("servos", servos,
              "GPs learn the positions that servos reach; the prior predicts the rest of the robot from them",
              published(false));
  }
};

/// GPs whose mean is the prior as given: Black-DROPS with priors.
struct FixedPrior {
  ResidualGpOptions gp;
  void fields(FieldVisitor& v) { v.group("gp", gp); }
};

/// The prior's parameters alone, by the squared one-step error; variance 0.
struct Mi : LeastSquares {
  struct Posterior {
    double misfit_observations = 1;  // φ takes more of the misfit upon it where no GP does
    void fields(FieldVisitor& v) {
      v.number("misfit_observations", misfit_observations, expert(PhiPosteriorOptions::kObservations), above(0));
    }
  } posterior;
  void fields(FieldVisitor& v) {
    LeastSquares::fields(v);
    v.group("posterior", posterior);
  }
};

/// GP-MI's search for the φ of the highest score.
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
    v.choice("score", score, "combination of the outputs' marginal likelihoods into one score",
             {"sum", "product", "harmonic"}, published("sum"));
    v.choice("search", search,
             "kernels and prior parameters optimised in turn, or kernels fitted anew for each parameter value",
             {"alternating", "nested"}, published("nested"));
    v.group("subplex", subplex);
    v.boolean("least_squares_start", least_squares_start,
              "the search starts from the parameters of least squared error, too", published(false));
    v.group("least_squares", least_squares, kExpert);
    v.group("posterior", posterior);
  }
};

using Kind = std::variant<ZeroMean, FixedPrior, GpMi, Mi>;

}  // namespace rehearse::identification
