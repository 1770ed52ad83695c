#include "rehearse/dynamics/learn.hpp"

#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/dynamics/alternating.hpp"
#include "rehearse/dynamics/estimate.hpp"
#include "rehearse/dynamics/least_squares.hpp"
#include "rehearse/dynamics/measurement_noise.hpp"
#include "rehearse/dynamics/residuals.hpp"
#include "rehearse/dynamics/simulator_model.hpp"

namespace rehearse::dynamics {
namespace {

Learned model_of(const Residuals& residuals, const prior::Prior* prior, const GpOptions& options,
                 const Estimate& estimate) {
  const Residuals::Rows rows = residuals.at(prior, estimate.phi);
  if (!rows.inputs) throw InvalidInput("no row of the data set has a finite prior mean: nothing to learn from");
  std::optional<Mean> mean;
  if (prior) mean = Mean{*prior, estimate.phi, residuals.midpoint()};
  Learned learned;
  learned.state.kernels = hyperparameters(estimate);
  const auto model = std::make_shared<GpModel>(
      residuals.features(), residuals.kinematics(), mean,
      gp::Posterior(*rows.inputs, rows.targets, learned.state.kernels, options.tolerance), options.variance);
  model->set_measurement_std(measurement_std(*model, residuals.data(), model->posterior().noise_variances()));
  learned.model = model;
  if (prior) learned.state.phi = estimate.phi;
  learned.log_evidence = estimate.log_evidences.sum();
  learned.left_out_rows = rows.left_out;
  learned.evaluations = estimate.evaluations;
  for (Index e = 0; e < estimate.log_evidences.size(); ++e)
    if (!std::isfinite(estimate.log_evidences(e)))
      learned.notes.push_back(fmt::format("the kernel of output {} could not be fitted", e));
  return learned;
}

/// GPs around the prior at φ (null: around zero).
Learned learn_gps(const Residuals& residuals, const prior::Prior* prior, const Vector& phi, const GpOptions& options,
                  const WarmStart& start, const Evaluator& evaluator) {
  Estimate estimate = unfitted(phi, residuals.scale().size(), start.kernels);
  Estimation{residuals, prior, Score::product, options.fit, evaluator}.refit(estimate);
  return model_of(residuals, prior, options, estimate);
}

Learned learn_kind(const ZeroMean& kind, const Residuals& residuals, const prior::Prior*, const WarmStart& start,
                   const Evaluator& evaluator) {
  return learn_gps(residuals, nullptr, {}, kind.gp, start, evaluator);
}

Learned learn_kind(const FixedPrior& kind, const Residuals& residuals, const prior::Prior* prior,
                   const WarmStart& start, const Evaluator& evaluator) {
  return learn_gps(residuals, prior, prior->space.values(), kind.gp, start, evaluator);
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
      const Vector other = least_squares(estimation_.residuals, prior, phi, kind.least_squares.subplex).phi;
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

Learned learn_kind(const GpMi& kind, const Residuals& residuals, const prior::Prior* prior, const WarmStart& start,
                   const Evaluator& evaluator) {
  const Estimation estimation{residuals, prior, kind.score, kind.gp.fit, evaluator};
  const Vector phi = start.phi.value_or(prior->space.values());
  Estimate found = kind.search == PhiSearch::nested ? NestedSearch(estimation).run(kind, phi, start.kernels)
                                                    : search_by_turns(kind, estimation, start);
  if (!std::isfinite(found.score)) estimation.refit(found);
  Learned learned = model_of(residuals, prior, kind.gp, found);
  learned.score = found.score;
  add_posterior(learned, *prior, phi_posterior(estimation, found, kind.posterior));
  return learned;
}

Learned learn_kind(const Mi& kind, const Residuals& residuals, const prior::Prior* prior, const WarmStart& start,
                   const Evaluator& evaluator) {
  const Identified identified = least_squares(residuals, *prior, start.phi, kind.subplex);
  Learned learned;
  learned.model = std::make_shared<SimulatorModel>(*prior, identified.phi);
  learned.state.phi = identified.phi;
  learned.evaluations = identified.evaluations;
  learned.left_out_rows = residuals.at(prior, identified.phi).left_out;
  add_posterior(learned, *prior, phi_posterior(residuals, *prior, identified.phi, kind.posterior, evaluator));
  return learned;
}

Residuals residuals_of(const Dataset& data, const FeatureMap& features, const Kinematics& kinematics,
                       const GpOptions& gp, bool midpoint) {
  return Residuals(data, gp.joint_angles ? features : FeatureMap(features.kinds()),
                   gp.integrate_rates ? kinematics : Kinematics{}, midpoint);
}

template <class GpKind>
Residuals residuals_of(const Dataset& data, const FeatureMap& features, const Kinematics& kinematics,
                       const GpKind& kind) {
  return residuals_of(data, features, kinematics, kind.gp, kind.gp.midpoint);
}
Residuals residuals_of(const Dataset& data, const FeatureMap& features, const Kinematics& kinematics,
                       const ZeroMean& kind) {
  return residuals_of(data, features, kinematics, kind.gp, false);
}
Residuals residuals_of(const Dataset& data, const FeatureMap& features, const Kinematics&, const Mi&) {
  return Residuals(data, features);
}

}  // namespace

Learned learn(const Dataset& data, const FeatureMap& features, const Kinematics& kinematics, const prior::Prior* prior,
              const Kind& kind, const WarmStart& start, const Evaluator& evaluator) {
  if (!prior && !std::holds_alternative<ZeroMean>(kind)) throw InvalidInput("this dynamics model needs a prior");
  if (data.size() == 0) throw InvalidInput("the data set has no row to learn from");
  const auto learn_this = [&](const auto& k) {
    return learn_kind(k, residuals_of(data, features, kinematics, k), prior, start, evaluator);
  };
  return std::visit(learn_this, kind);
}

}  // namespace rehearse::dynamics
