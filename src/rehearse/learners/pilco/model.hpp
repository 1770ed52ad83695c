#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/gp/fit.hpp"
#include "rehearse/identification/learn.hpp"
#include "rehearse/moments/expected_return.hpp"
#include "rehearse/moments/make_prior_moments.hpp"
#include "rehearse/moments/step_dynamics.hpp"

namespace rehearse::learners::pilco {

struct ModelOptions {
  gp::FitOptions fit;
  bool joint_angles = true;            // inputs have those that the task names too; PILCO: angles as they are
  bool smooth = false;                 // noisy states are smoothed where that makes what was measured likelier
                                       // (identification/smoothing/smoothing.hpp); PILCO: never
  Index inducing = 1500;               // more rows than so many are summed up by so many inducing inputs: FITC, which
                                       // may lose a swing that all rows know (PILCO: 300)
  Index inducing_line_searches = 100;  // that place them, from rows spread evenly over the trials (PILCO: 500, from
                                       // random rows)
  ModelOptions() {
    fit.penalties.length = fit.penalties.snr = true;
    fit.penalties.snr_limit = 1000;  // PILCO
  }
  void fields(FieldVisitor& v);
};

/// The mean functions of GPs: zero, where both are empty.
struct Mean {
  std::vector<moments::MomentTerm> network = {};  // GPs learned elsewhere, without uncertainty (Cutler 2015)
  const prior::Prior* prior = nullptr;            // a simulator (Saveriano 2017)
  moments::Through through = moments::Through::linearised;
  bool identify = false;  // GP-MI finds its parameters; else it is taken at its own
};

/// GPs for the change of each state.
struct Model {
  moments::StepDynamics moments;                          // what policies are searched on; false: it could not be made
  std::shared_ptr<const dynamics::DynamicsModel> model;   // the same GPs of all rows, for forecasts
  moments::MakeMoments moments_of_all_rows;               // of these GPs, made when it is called; empty: there are none
  identification::WarmStart state;                        // of the next
  double log_evidence = 0;                                // of all outputs together, nats; NaN where a fit failed
  std::optional<identification::PhiPosterior> posterior;  // of the prior's parameters, where they were identified
  Index left_out_rows = 0;                                // of the data, where the prior's mean was not finite
  std::vector<std::string> notes;                         // numerical failures survived
};

/// The data that a model is learned from, and the options. References must outlive the calls.
struct ModelProblem {
  const Task& task;
  const Dataset& data;
  const ModelOptions& options;
  const Evaluator& evaluator;
  ProgressSink progress = {};
};

/// `start`: of the model before; may be empty. `mean`: what it points to must outlive the call. The same for any number
/// of threads. No data throw; what the progress sink throws, passes.
Model learn(const ModelProblem& problem, const identification::WarmStart& start, const Mean& mean = {});

/// GPs with these kernels and zero mean: all rows, or, beyond `options.inducing` of them, inducing inputs.
std::vector<moments::MomentTerm> terms_of(const ModelProblem& problem, const std::vector<gp::Hyperparameters>& kernels,
                                          std::vector<std::string>& notes);

}  // namespace rehearse::learners::pilco
