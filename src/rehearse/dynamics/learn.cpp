#include "rehearse/dynamics/learn.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/dynamics/identification.hpp"
#include "rehearse/dynamics/residuals.hpp"
#include "rehearse/dynamics/simulator_model.hpp"

namespace rehearse::dynamics {
namespace {

constexpr double kWorst = -std::numeric_limits<double>::infinity();

struct Kernels {
  std::vector<gp::Hyperparameters> fitted;
  Vector log_evidences;
  std::vector<std::string> notes;
};

std::vector<gp::Hyperparameters> starts(const Residuals::Rows& rows, const Vector& scale,
                                        const std::vector<gp::Hyperparameters>& warm, const gp::Bounds& bounds) {
  if (!warm.empty()) return warm;
  std::vector<gp::Hyperparameters> kernels;
  for (Index e = 0; e < scale.size(); ++e)
    kernels.push_back(gp::default_start(*rows.inputs, rows.targets.col(e), scale(e), bounds));
  return kernels;
}

/// Fits the kernel of every output, in parallel.
Kernels fit_kernels(const Residuals::Rows& rows, const Vector& scale, const std::vector<gp::Hyperparameters>& start,
                    const gp::FitOptions& options, const Evaluator& evaluator) {
  const Index outputs = scale.size(), size = start.front().flat().size();
  Matrix results(size + 2, outputs);  // kernel, log evidence, whether it failed
  evaluator.evaluate(
      [&](Index e, VectorView result) {
        const gp::Fit fit =
            gp::fit(*rows.inputs, rows.targets.col(e), scale(e), start[static_cast<std::size_t>(e)], options);
        result.head(size) = fit.hyperparameters.flat();
        result(size) = fit.log_evidence;
        result(size + 1) = fit.status == gp::Fit::Status::failed;
      },
      results);
  Kernels kernels{.log_evidences = results.row(size).transpose()};
  for (Index e = 0; e < outputs; ++e) {
    kernels.fitted.push_back(gp::Hyperparameters::from_flat(results.col(e).head(size)));
    if (results(size + 1, e) != 0)
      kernels.notes.push_back(fmt::format("the kernel of output {} could not be fitted", e));
  }
  return kernels;
}

void require_rows(const Residuals::Rows& rows) {
  if (!rows.inputs) throw InvalidInput("no row of the data set has a finite prior mean: nothing to learn from");
}

/// GPs around the prior at φ (null: around zero), their kernels fitted from `warm`.
Learned learn_gps(const Residuals& residuals, const FeatureMap& features, const prior::Prior* prior, const Vector& phi,
                  const GpOptions& options, const std::vector<gp::Hyperparameters>& warm, const Evaluator& evaluator) {
  const Residuals::Rows rows = residuals.at(prior, phi);
  require_rows(rows);
  Kernels kernels = fit_kernels(rows, residuals.scale(), starts(rows, residuals.scale(), warm, options.fit.bounds),
                                options.fit, evaluator);
  std::optional<Mean> mean;
  if (prior) mean = Mean{*prior, phi};
  Learned learned;
  learned.model = std::make_shared<GpModel>(
      features, mean, gp::Posterior(*rows.inputs, rows.targets, kernels.fitted, options.tolerance), options.variance);
  learned.state.kernels = std::move(kernels.fitted);
  if (prior) learned.state.phi = phi;
  learned.log_evidence = kernels.log_evidences.sum();
  learned.left_out_rows = rows.left_out;
  learned.notes = std::move(kernels.notes);
  return learned;
}

Learned learn_kind(const ZeroMean& kind, const Residuals& residuals, const FeatureMap& features, const prior::Prior*,
                   const WarmStart& start, const Evaluator& evaluator) {
  return learn_gps(residuals, features, nullptr, {}, kind.gp, start.kernels, evaluator);
}

Learned learn_kind(const FixedPrior& kind, const Residuals& residuals, const FeatureMap& features,
                   const prior::Prior* prior, const WarmStart& start, const Evaluator& evaluator) {
  return learn_gps(residuals, features, prior, prior->space.values(), kind.gp, start.kernels, evaluator);
}

/// The φ of the least mean squared one-step error. A row that fails is charged the variance of the changes, so that a φ
/// at which rows fail does not win by having fewer of them to predict.
Identified least_squares(const Mi& kind, const Residuals& residuals, const prior::Prior& prior,
                         const std::optional<Vector>& start) {
  const double charge = residuals.scale().squaredNorm();
  const auto objective = [&](const Vector& phi) {
    const Residuals::Rows rows = residuals.at(&prior, phi);
    const double charged = static_cast<double>(rows.left_out) * charge;
    return rows.inputs ? -(rows.targets.squaredNorm() + charged) / static_cast<double>(residuals.size()) : kWorst;
  };
  return identify(prior.space, start, objective, kind.subplex);
}

/// The score of a φ: every kernel is fitted again, from where the best φ so far had it.
class EvidenceOfPhi {
 public:
  EvidenceOfPhi(const GpMi& kind, const Residuals& residuals, const prior::Prior& prior,
                std::vector<gp::Hyperparameters> kernels, const Evaluator& evaluator)
      : kind_(kind), residuals_(residuals), prior_(prior), kernels_(std::move(kernels)), evaluator_(evaluator) {}

  double operator()(const Vector& phi) {
    const Residuals::Rows rows = residuals_.at(&prior_, phi);
    if (!rows.inputs) return kWorst;
    Kernels kernels =
        fit_kernels(rows, residuals_.scale(), starts(rows, residuals_.scale(), kernels_, kind_.gp.fit.bounds),
                    kind_.gp.fit, evaluator_);
    // A φ at which rows fail must not win by having fewer of them to explain: a row that fails counts as if the model
    // knew no more of it than the spread of the changes.
    const Vector uninformed =
        -0.5 - residuals_.scale().array().max(1e-300).log() - 0.5 * std::log(2 * std::numbers::pi);
    const double score = score_of(kernels.log_evidences + static_cast<double>(rows.left_out) * uninformed, kind_.score);
    if (score > best_) best_ = score, kernels_ = std::move(kernels.fitted);
    return score;
  }

  const std::vector<gp::Hyperparameters>& kernels() const { return kernels_; }

 private:
  const GpMi& kind_;
  const Residuals& residuals_;
  const prior::Prior& prior_;
  std::vector<gp::Hyperparameters> kernels_;
  const Evaluator& evaluator_;
  double best_ = kWorst;
};

/// Chatzilygeroudis 2018, Algorithm 2.
Learned learn_kind(const GpMi& kind, const Residuals& residuals, const FeatureMap& features, const prior::Prior* prior,
                   const WarmStart& start, const Evaluator& evaluator) {
  EvidenceOfPhi score(kind, residuals, *prior, start.kernels, evaluator);
  Vector from = start.phi.value_or(prior->space.values());
  if (kind.least_squares_start && prior->space.has_tunable()) {
    const Vector other = least_squares(kind.least_squares, residuals, *prior, from).phi;
    if (score(other) > score(from)) from = other;
  }
  const Identified identified = identify(prior->space, from, std::ref(score), kind.subplex);
  Learned learned = learn_gps(residuals, features, prior, identified.phi, kind.gp, score.kernels(), evaluator);
  learned.evaluations = identified.evaluations;
  return learned;
}

Learned learn_kind(const Mi& kind, const Residuals& residuals, const FeatureMap&, const prior::Prior* prior,
                   const WarmStart& start, const Evaluator&) {
  const Identified identified = least_squares(kind, residuals, *prior, start.phi);
  Learned learned;
  learned.model = std::make_shared<SimulatorModel>(*prior, identified.phi);
  learned.state.phi = identified.phi;
  learned.evaluations = identified.evaluations;
  learned.left_out_rows = residuals.at(prior, identified.phi).left_out;
  return learned;
}

}  // namespace

double score_of(const Vector& log_likelihoods, Score score) {
  if (!log_likelihoods.allFinite()) return kWorst;
  if (score == Score::product) return log_likelihoods.sum();
  // The harmonic mean n / Σ 1/p_i; log Σ exp in both cases, of log p_i or of −log p_i.
  const double sign = score == Score::sum ? 1 : -1;
  const double largest = (sign * log_likelihoods).maxCoeff();
  const double log_sum = largest + std::log((sign * log_likelihoods.array() - largest).exp().sum());
  return score == Score::sum ? log_sum : std::log(static_cast<double>(log_likelihoods.size())) - log_sum;
}

Learned learn(const Dataset& data, const FeatureMap& features, const prior::Prior* prior, const Kind& kind,
              const WarmStart& start, const Evaluator& evaluator) {
  if (!prior && !std::holds_alternative<ZeroMean>(kind)) throw InvalidInput("this dynamics model needs a prior");
  if (data.size() == 0) throw InvalidInput("the data set has no row to learn from");
  const Residuals residuals(data, features);
  return std::visit([&](const auto& k) { return learn_kind(k, residuals, features, prior, start, evaluator); }, kind);
}

}  // namespace rehearse::dynamics
