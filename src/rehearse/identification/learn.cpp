#include "rehearse/identification/learn.hpp"

#include <cmath>

#include "rehearse/core/errors.hpp"
#include "rehearse/dynamics/actuated_model.hpp"
#include "rehearse/dynamics/integration.hpp"
#include "rehearse/dynamics/residuals.hpp"
#include "rehearse/dynamics/servos.hpp"
#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/identification/alternating.hpp"
#include "rehearse/identification/fit_problem.hpp"
#include "rehearse/identification/mirror_image.hpp"
#include "rehearse/identification/nested.hpp"
#include "rehearse/identification/smoothing/measurement_noise.hpp"
#include "rehearse/identification/smoothing/smoothing.hpp"

namespace rehearse::identification {
namespace {

// A robot is taken for its own mirror image where its data are likelier by so many nats an output, on average: 1000
// to 1.
constexpr double kOddNats = 7;

/// The input of every kind of learning.
struct Given {
  const LearningProblem& problem;
  const WarmStart& start;
  const Evaluator& evaluator;

  dynamics::Residuals residuals(const GpOptions& gp, bool integrates_rates) const {
    const FeatureMap& features = problem.features;
    Kinematics known = problem.kinematics;
    if (!integrates_rates) known.pairs.clear();
    return dynamics::Residuals(problem.data,
                               gp.joint_angles ? features : FeatureMap(features.kinds(), {}, features.targets()),
                               std::move(known), gp.midpoint);
  }
};

gp::FitOptions fit_options(const GpOptions& options, const dynamics::Residuals& residuals) {
  return dynamics::fit_options(options.fit, residuals.features().features() + residuals.data().actions.cols());
}

/// The variances of noise of the changes that a model predicts (dx): of positions, that of their rates is a part.
Vector noise_of_changes(const dynamics::GpModel& model, const dynamics::Residuals& rows) {
  Matrix variances = model.posterior().noise_variances().transpose();
  dynamics::add_variances_of_integrals(rows.kinematics(), variances);
  return variances.transpose();
}

/// Is the robot learned as its own mirror image? As the user says, or as the data do where the prior does not
/// contradict it.
bool is_odd(const FitProblem& problem, const Fit& fit, const GpOptions& options) {
  const dynamics::Residuals& residuals = problem.residuals;
  if (options.mirror != dynamics::Mirror::automatic) return options.mirror == dynamics::Mirror::on;
  const dynamics::Residuals::Rows rows = residuals.at(problem.prior, fit.phi);
  if (!rows.inputs || rows.inputs->dimensions() > dynamics::kFewInputs) return false;
  if (problem.prior && not_its_image(residuals, *problem.prior, fit.phi, {})) return false;
  Index learned = 0;
  for (Index e = 0; e < rows.targets.cols(); ++e) learned += !residuals.predicted_by_servos(e);
  return nats_for_odd(residuals, rows, fit) > kOddNats * static_cast<double>(learned);
}

/// `smoothed`: null if measurement noise is to be estimated from the kernels' noise. names: of states, for notes.
Learned model_of(const FitProblem& problem, const Fit& fit, const GpOptions& options, bool odd,
                 const Smoothed* smoothed, const std::vector<std::string>& names) {
  const dynamics::Residuals& residuals = problem.residuals;
  const dynamics::Residuals::Rows rows = residuals.at(problem.prior, fit.phi);
  if (!rows.inputs) throw NoUsableRow("no row of the data set has a finite prior mean: nothing to learn from");
  std::optional<dynamics::Mean> mean;
  if (problem.prior) mean = dynamics::Mean{*problem.prior, fit.phi};
  Learned learned;
  learned.state.kernels = hyperparameters(fit);
  const auto model = std::make_shared<dynamics::GpModel>(
      residuals.features(), residuals.kinematics(), mean,
      gp::Posterior(*rows.inputs, rows.targets, learned.state.kernels, options.tolerance,
                    odd ? signs_of_images(residuals.features(), residuals.data().actions.cols()) : Vector()),
      options.variance, residuals.midpoint());
  model->set_measurement_std(smoothed ? smoothed->measurement_std
                                      : measurement_std(*model, residuals.data(), noise_of_changes(*model, residuals)));
  learned.model = model;
  if (problem.prior) learned.state.phi = fit.phi;
  double evidence = 0;
  for (Index e = 0; e < fit.log_evidences.size(); ++e)
    if (!residuals.predicted_by_servos(e)) evidence += fit.log_evidences(e);
  learned.log_evidence = evidence;
  learned.left_out_rows = rows.left_out;
  learned.evaluations = fit.evaluations;
  learned.state.odd = odd;
  if (options.mirror == dynamics::Mirror::on) {
    std::optional<std::string> note;
    if (problem.prior) note = not_its_image(residuals, *problem.prior, fit.phi, names);
    if (!note) note = contradicts_image(*model, residuals, noise_of_changes(*model, residuals), names);
    if (note) learned.notes.push_back(std::move(*note));
  }
  return learned;
}

/// A note where the data's answer to `automatic` is another than the time before.
Learned with_answer(Learned learned, const WarmStart& before, const GpOptions& options) {
  if (options.mirror != dynamics::Mirror::automatic || learned.state.odd == before.odd) return learned;
  learned.notes.emplace_back(
      learned.state.odd
          ? "the data are likelier of a robot that is its own mirror image: it is learned as one from now on"
          : "the data no longer say that the robot is its own mirror image: it is learned without");
  return learned;
}

/// The model of a fit, or of what smoothing makes of it where that is likelier. finish(problem, fit,
/// smoothed) makes the model; the last is null where nothing was smoothed.
template <class Finish>
Learned smoothed_if_likelier(const Given& given, const GpOptions& options, const FitProblem& measured, const Fit& fit,
                             bool moves_phi, Finish finish) {
  const bool behind_servos =
      !given.problem.kinematics.servos.empty();  // whose actions are noisy measurements themselves
  if (!options.smooth || behind_servos) return finish(measured, fit, nullptr);
  const auto on = [&](const dynamics::Residuals& residuals) {
    return FitProblem{residuals, measured.prior, measured.score, measured.options, measured.evaluator};
  };
  const dynamics::Residuals residuals = given.residuals(options, true);
  const std::optional<Smoothed> smoothed = smooth(on(residuals), fit, moves_phi);
  if (!smoothed) return finish(measured, fit, nullptr);
  const dynamics::Residuals of_smoothed = residuals.of(smoothed->data);
  Learned learned = finish(on(of_smoothed), smoothed->fit, &*smoothed);
  learned.log_evidence = smoothed->fit.score;
  if (!moves_phi && learned.score) learned.score = fit.score;
  learned.smoothed = SmoothedRows{smoothed->data, hyperparameters(smoothed->fit)};
  learned.state.kernels = hyperparameters(fit);  // of measured rows, which the next trial starts with
  return learned;
}

/// GPs around the prior as it is; null: around zero.
Learned learn_gps(const Given& given, const GpOptions& options, const prior::Prior* prior) {
  const dynamics::Residuals residuals = given.residuals(options, options.integrate_rates);
  const FitProblem problem{residuals, prior, Score::product, fit_options(options, residuals), given.evaluator};
  Fit fit = unfitted(prior ? prior->space.values() : Vector(), residuals.scale().size(), given.start.kernels);
  problem.refit(fit);
  const bool odd = is_odd(problem, fit, options);
  const auto finish = [&](const FitProblem& of, const Fit& made, const Smoothed* smoothed) {
    return model_of(of, made, options, odd, smoothed, given.problem.state_names);
  };
  return with_answer(smoothed_if_likelier(given, options, problem, fit, false, finish), given.start, options);
}

Learned learn_kind(const ZeroMean& kind, const Given& given) { return learn_gps(given, kind.gp, nullptr); }

Learned learn_kind(const FixedPrior& kind, const Given& given) {
  return learn_gps(given, kind.gp, given.problem.prior);
}

/// Fails where the prior tunes something and a number is not finite.
void add_posterior(Learned& learned, const prior::Prior& prior, std::optional<PhiPosterior> posterior) {
  learned.posterior = std::move(posterior);
  if (!learned.posterior && !prior.space.of_kind(Parameter::Kind::continuous).empty())
    learned.notes.emplace_back("how sure the parameters are could not be computed");
}

Learned learn_kind(const GpMi& kind, const Given& given) {
  const prior::Prior& prior = *given.problem.prior;
  const dynamics::Residuals residuals = given.residuals(kind.gp, kind.gp.integrate_rates);
  const FitProblem problem{residuals, &prior, kind.score, fit_options(kind.gp, residuals), given.evaluator};
  Fit found = kind.search == PhiSearch::nested ? search_nested(kind, problem, given.start)
                                               : search_by_turns(kind, problem, given.start);
  if (!std::isfinite(found.score)) problem.refit(found);
  const bool odd = is_odd(problem, found, kind.gp);
  const auto finish = [&](const FitProblem& of, const Fit& fit, const Smoothed* smoothed) {
    Learned learned = model_of(of, fit, kind.gp, odd, smoothed, given.problem.state_names);
    learned.score = fit.score;
    add_posterior(
        learned, prior,
        smoothed ? phi_posterior(of, fit, smoothed->steps, kind.posterior) : phi_posterior(of, fit, kind.posterior));
    return learned;
  };
  // Smoothing climbs the product of likelihoods by turns; what another score or search chose stays.
  const bool moves_phi = kind.score == Score::product && kind.search == PhiSearch::alternating;
  return with_answer(smoothed_if_likelier(given, kind.gp, problem, found, moves_phi, finish), given.start, kind.gp);
}

Learned learn_kind(const Mi& kind, const Given& given) {
  const prior::Prior& prior = *given.problem.prior;
  const dynamics::Residuals residuals(given.problem.data, given.problem.features);
  const Identified identified = least_squares(residuals, prior, given.start.phi, kind);
  Learned learned;
  learned.model = std::make_shared<dynamics::SimulatorModel>(prior, identified.phi);
  learned.state.phi = identified.phi;
  learned.evaluations = identified.evaluations;
  learned.left_out_rows = residuals.at(&prior, identified.phi).left_out;
  add_posterior(learned, prior,
                phi_posterior(residuals, prior, identified.phi, kind.posterior.misfit_observations, given.evaluator));
  return learned;
}

/// The options if GPs learn servos first; null: the kind has no GPs around a prior, or servos are off.
const ResidualGpOptions* servo_options(const Kind& kind) {
  const auto with_servos = [](const auto& k) -> const ResidualGpOptions* {
    if constexpr (requires { k.gp.servos; }) return k.gp.servos ? &k.gp : nullptr;
    return nullptr;
  };
  return std::visit(with_servos, kind);
}

/// Learns a model of the robot behind its actuators. In front of this model they stand as they are known to be.
Learned learn_behind_actuators(const LearningProblem& problem, const Kind& kind, const WarmStart& start,
                               const Evaluator& evaluator) {
  const auto& [data, features, kinematics, prior, actuators, names] = problem;
  const auto own_kinds = features.kinds().begin() + actuators.own_states();
  const FeatureMap own(std::vector<StateKind>(features.kinds().begin(), own_kinds), features.joints(),
                       features.targets());
  std::optional<prior::Prior> robot;
  if (prior) robot = prior->behind_actuators();
  Learned learned = learn({dynamics::actuated(data, actuators), own, kinematics, robot ? &*robot : nullptr, {}, names},
                          kind, start, evaluator);
  learned.model = std::make_shared<dynamics::ActuatedModel>(learned.model, actuators);
  return learned;
}

}  // namespace

Learned learn(const LearningProblem& problem, const Kind& kind, const WarmStart& start, const Evaluator& evaluator) {
  const auto& [data, features, kinematics, prior, actuators, names] = problem;
  if (!prior && !std::holds_alternative<ZeroMean>(kind)) throw InvalidInput("this dynamics model needs a prior");
  if (data.size() == 0) throw InvalidInput("the data set has no row to learn from");
  if (actuators.memory() > 0) return learn_behind_actuators(problem, kind, start, evaluator);
  const auto learn_from = [&](const LearningProblem& of) {
    return std::visit([&](const auto& k) { return learn_kind(k, Given{of, start, evaluator}); }, kind);
  };
  const ResidualGpOptions* options = servo_options(kind);
  if (!options || kinematics.servos.empty()) {
    Kinematics without = kinematics;
    without.servos.clear();
    return learn_from({data, features, without, prior, {}, names});
  }
  const auto servos = std::make_shared<dynamics::Servos>(data, features, kinematics.servos, *options, evaluator);
  const prior::Prior driven = prior->behind_servos();
  Learned learned = learn_from({dynamics::reached(data, kinematics.servos), features, kinematics, &driven, {}, names});
  learned.model = std::make_shared<dynamics::ServoModel>(servos, learned.model);
  *learned.log_evidence += servos->log_evidence();
  return learned;
}

}  // namespace rehearse::identification
