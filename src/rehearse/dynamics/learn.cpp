#include "rehearse/dynamics/learn.hpp"

#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/dynamics/alternating.hpp"
#include "rehearse/dynamics/estimate.hpp"
#include "rehearse/dynamics/measurement_noise.hpp"
#include "rehearse/dynamics/residuals.hpp"
#include "rehearse/dynamics/servos.hpp"
#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/dynamics/smoothing.hpp"

namespace rehearse::dynamics {
namespace {

/// What all kinds learn from.
struct Problem {
  const Dataset& data;
  const FeatureMap& features;
  const Kinematics& kinematics;
  const prior::Prior* prior;
  const WarmStart& start;
  const Evaluator& evaluator;

  Residuals residuals(const GpOptions& gp, bool integrates_rates, bool midpoint) const {
    Kinematics known = kinematics;
    if (!integrates_rates) known.pairs.clear();
    return Residuals(data, gp.joint_angles ? features : FeatureMap(features.kinds(), {}, features.targets()),
                     std::move(known), midpoint);
  }
};

gp::FitOptions fit_options(const GpOptions& options, const Residuals& residuals) {
  return dynamics::fit_options(options.fit, residuals.features().features() + residuals.data().actions.cols());
}

/// `smoothed`: null where noise of measurements is to be told from what the kernels take for noise.
Learned model_of(const Estimation& estimation, const Estimate& estimate, const GpOptions& options,
                 const Smoothed* smoothed) {
  const Residuals& residuals = estimation.residuals;
  const Residuals::Rows rows = residuals.at(estimation.prior, estimate.phi);
  if (!rows.inputs) throw InvalidInput("no row of the data set has a finite prior mean: nothing to learn from");
  std::optional<Mean> mean;
  if (estimation.prior) mean = Mean{*estimation.prior, estimate.phi, residuals.midpoint()};
  Learned learned;
  learned.state.kernels = hyperparameters(estimate);
  const auto model = std::make_shared<GpModel>(
      residuals.features(), residuals.kinematics(), mean,
      gp::Posterior(*rows.inputs, rows.targets, learned.state.kernels, options.tolerance), options.variance);
  model->set_measurement_std(smoothed
                                 ? smoothed->measurement_std
                                 : measurement_std(*model, residuals.data(), model->posterior().noise_variances()));
  learned.model = model;
  if (estimation.prior) learned.state.phi = estimate.phi;
  learned.log_evidence = estimate.log_evidences.sum();
  learned.left_out_rows = rows.left_out;
  learned.evaluations = estimate.evaluations;
  for (Index e = 0; e < estimate.log_evidences.size(); ++e)
    if (!std::isfinite(estimate.log_evidences(e)))
      learned.notes.push_back(fmt::format("the kernel of output {} could not be fitted", e));
  return learned;
}

/// The model of an estimate, or of what smoothing makes of it where that is likelier. finish(estimation, estimate,
/// smoothed) makes the model; the last is null where nothing was smoothed.
template <class Finish>
Learned smoothed_if_likelier(const Problem& problem, const GpOptions& options, const Estimation& measured,
                             const Estimate& estimate, bool moves_phi, Finish finish) {
  const bool behind_servos = !problem.kinematics.servos.empty();  // whose actions are noisy measurements themselves
  if (!options.smooth || behind_servos) return finish(measured, estimate, nullptr);
  const auto on = [&](const Residuals& residuals) {
    return Estimation{residuals, measured.prior, measured.score, measured.fit, measured.evaluator};
  };
  const Residuals residuals = problem.residuals(options, true, measured.residuals.midpoint());
  const std::optional<Smoothed> smoothed = smooth(on(residuals), estimate, moves_phi);
  if (!smoothed) return finish(measured, estimate, nullptr);
  const Residuals of_smoothed = residuals.of(smoothed->data);
  Learned learned = finish(on(of_smoothed), smoothed->estimate, &*smoothed);
  learned.log_evidence = smoothed->estimate.score;
  if (!moves_phi && learned.score) learned.score = estimate.score;
  learned.smoothed = SmoothedRows{smoothed->data, hyperparameters(smoothed->estimate)};
  learned.state.kernels = hyperparameters(estimate);  // of measured rows, which the next trial starts with
  return learned;
}

/// GPs around the prior as it is; null: around zero.
Learned learn_gps(const Problem& problem, const GpOptions& options, const prior::Prior* prior, bool midpoint) {
  const Residuals residuals = problem.residuals(options, options.integrate_rates, midpoint);
  const Estimation estimation{residuals, prior, Score::product, fit_options(options, residuals), problem.evaluator};
  Estimate estimate =
      unfitted(prior ? prior->space.values() : Vector(), residuals.scale().size(), problem.start.kernels);
  estimation.refit(estimate);
  const auto finish = [&](const Estimation& of, const Estimate& made, const Smoothed* smoothed) {
    return model_of(of, made, options, smoothed);
  };
  return smoothed_if_likelier(problem, options, estimation, estimate, false, finish);
}

Learned learn_kind(const ZeroMean& kind, const Problem& problem) { return learn_gps(problem, kind.gp, nullptr, false); }

Learned learn_kind(const FixedPrior& kind, const Problem& problem) {
  return learn_gps(problem, kind.gp, problem.prior, kind.gp.midpoint);
}

/// Fails where the prior tunes something and a number is not finite.
void add_posterior(Learned& learned, const prior::Prior& prior, std::optional<PhiPosterior> posterior) {
  learned.posterior = std::move(posterior);
  if (!learned.posterior && !prior.space.of_kind(Parameter::Kind::continuous).empty())
    learned.notes.emplace_back("how sure the parameters are could not be computed");
}

/// Algorithm 2 of Chatzilygeroudis 2018: every φ's kernels are fitted again, from where the best φ so far had them.
class NestedSearch {
 public:
  explicit NestedSearch(const Estimation& estimation) : estimation_(estimation) {}

  Estimate run(const GpMi& kind, const Vector& phi, const std::vector<gp::Hyperparameters>& kernels) {
    const prior::Prior& prior = *estimation_.prior;
    best_ = unfitted(phi, estimation_.residuals.scale().size(), kernels);
    Vector from = phi;
    if (kind.least_squares_start && prior.space.has_tunable()) {
      const Vector other = least_squares(estimation_.residuals, prior, phi, kind.least_squares).phi;
      const double given = score(phi);
      if (score(other) > given) from = other;
    }
    const auto objective = [this](const Vector& at) { return score(at); };
    const Identified identified = identify(prior.space, from, objective, kind.subplex);
    best_.evaluations = identified.evaluations;
    return best_;
  }

 private:
  double score(const Vector& phi) {
    if (phi == best_.phi && std::isfinite(best_.score)) return best_.score;
    Estimate estimate = best_;
    estimate.phi = phi;
    estimation_.refit(estimate);
    const double score = estimate.score;
    if (score > best_.score) best_ = std::move(estimate);
    return score;
  }

  const Estimation& estimation_;
  Estimate best_;
};

Learned learn_kind(const GpMi& kind, const Problem& problem) {
  const prior::Prior& prior = *problem.prior;
  const Residuals residuals = problem.residuals(kind.gp, kind.gp.integrate_rates, kind.gp.midpoint);
  const Estimation estimation{residuals, &prior, kind.score, fit_options(kind.gp, residuals), problem.evaluator};
  const Vector phi = problem.start.phi.value_or(prior.space.values());
  Estimate found = kind.search == PhiSearch::nested ? NestedSearch(estimation).run(kind, phi, problem.start.kernels)
                                                    : search_by_turns(kind, estimation, problem.start);
  if (!std::isfinite(found.score)) estimation.refit(found);
  const auto finish = [&](const Estimation& of, const Estimate& estimate, const Smoothed* smoothed) {
    Learned learned = model_of(of, estimate, kind.gp, smoothed);
    learned.score = estimate.score;
    add_posterior(learned, prior,
                  smoothed ? phi_posterior(of, estimate, smoothed->steps, kind.posterior)
                           : phi_posterior(of, estimate, kind.posterior));
    return learned;
  };
  // Smoothing climbs the product of likelihoods by turns; what another score or search chose stays.
  const bool moves_phi = kind.score == Score::product && kind.search == PhiSearch::alternating;
  return smoothed_if_likelier(problem, kind.gp, estimation, found, moves_phi, finish);
}

Learned learn_kind(const Mi& kind, const Problem& problem) {
  const prior::Prior& prior = *problem.prior;
  const Residuals residuals(problem.data, problem.features);
  const Identified identified = least_squares(residuals, prior, problem.start.phi, kind);
  Learned learned;
  learned.model = std::make_shared<SimulatorModel>(prior, identified.phi);
  learned.state.phi = identified.phi;
  learned.evaluations = identified.evaluations;
  learned.left_out_rows = residuals.at(&prior, identified.phi).left_out;
  add_posterior(learned, prior, phi_posterior(residuals, prior, identified.phi, kind.posterior, problem.evaluator));
  return learned;
}

/// Null: the kind has none, or knows the actions as they are.
const ResidualGpOptions* servo_options(const Kind& kind) {
  const auto with_servos = [](const auto& k) -> const ResidualGpOptions* {
    if constexpr (requires { k.gp.servos; }) return k.gp.servos ? &k.gp : nullptr;
    return nullptr;
  };
  return std::visit(with_servos, kind);
}

}  // namespace

Learned learn(const Dataset& data, const FeatureMap& features, const Kinematics& kinematics, const prior::Prior* prior,
              const Kind& kind, const WarmStart& start, const Evaluator& evaluator) {
  if (!prior && !std::holds_alternative<ZeroMean>(kind)) throw InvalidInput("this dynamics model needs a prior");
  if (data.size() == 0) throw InvalidInput("the data set has no row to learn from");
  const auto learn_from = [&](const Dataset& rows, const Kinematics& known, const prior::Prior* around) {
    const Problem problem{rows, features, known, around, start, evaluator};
    return std::visit([&](const auto& k) { return learn_kind(k, problem); }, kind);
  };
  const ResidualGpOptions* options = servo_options(kind);
  if (!options || kinematics.servos.empty()) {
    Kinematics without = kinematics;
    without.servos.clear();
    return learn_from(data, without, prior);
  }
  const auto servos = std::make_shared<Servos>(data, features, kinematics.servos, *options, evaluator);
  const prior::Prior driven = prior->behind_servos();
  Learned learned = learn_from(reached(data, kinematics.servos), kinematics, &driven);
  learned.model = std::make_shared<ServoModel>(servos, learned.model);
  *learned.log_evidence += servos->log_evidence();
  return learned;
}

}  // namespace rehearse::dynamics
