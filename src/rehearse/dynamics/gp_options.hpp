#pragma once

#include "rehearse/core/options.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/gp/fit.hpp"

namespace rehearse::dynamics {

/// GPs of more inputs have one length for all of them and no trend: a few trials tell too little of more.
inline constexpr Index kFewInputs = 16;

/// The options of a fit for GPs of so many inputs.
gp::FitOptions fit_options(gp::FitOptions options, Index inputs);

/// Is the robot its own mirror image, so that predictions know the image of each row, too?
enum class Mirror {
  off,        // it is not, or nobody asks
  on,         // it is
  automatic,  // it is where that makes its data clearly likelier
};

/// Options for learning the GPs of a dynamics model.
struct GpOptions {
  gp::FitOptions fit;
  PredictedVariance variance = PredictedVariance::latent;
  bool joint_angles = true;      // inputs have those that the task names too
  bool integrate_rates = false;  // positions follow from their rates, GPs learn what is left (integration.hpp)
  bool midpoint = false;         // inputs are those halfway along a step (GpModel)
  bool smooth = false;  // noisy states are smoothed where that makes what was measured likelier (smoothing.hpp); φ
                        // moves with them where the score is the product and the search alternating
  Mirror mirror = Mirror::off;
  double tolerance = 0.01;  // error allowed to predictions, as a fraction of σ_n (gp::Posterior); 0: none
  void fields(FieldVisitor& v) {
    v.group("fit", fit, kExpert);
    v.boolean("trend", fit.trend, "the GPs have a quadratic trend beside their squared-exponential kernel",
              published(false));
    v.boolean("joint_angles", joint_angles, "GPs see the angles between links, too, where the task names them",
              published(false));
    v.boolean("integrate_rates", integrate_rates,
              "positions are integrated from their rates; GPs learn the remaining error", published(false));
    v.boolean("midpoint", midpoint,
              "the GPs' inputs are halfway along the step that the prior predicts, without one that rates predict",
              published(false));
    v.boolean("smooth", smooth, "noisy states are smoothed where that raises the likelihood of the measurements",
              published(false));
    v.choice("mirror", mirror,
             "opposite states and actions change by the opposite (a mirror image); auto: where the data say so",
             {"off", "on", "auto"}, published("off"));
    v.number("tolerance", tolerance,
             "largest error of approximate predictions, as a fraction of the noise's standard deviation; 0: exact",
             between(0, 1), published(0));
    v.choice("variance", variance, expert("variance of predictions: without the noise of observations, or with it"),
             {"latent", "noisy"});
  }
};

}  // namespace rehearse::dynamics
