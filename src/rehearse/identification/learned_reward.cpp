#include "rehearse/identification/learned_reward.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/vector_math.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/dynamics/residuals.hpp"
#include "rehearse/gp/posterior.hpp"

namespace rehearse::identification {
namespace {

/// The targets of a GP with zero mean, and the way back to rewards: r = y, or r = exp(min(y + offset, highest)) −
/// floor.
struct Targets {
  Vector y;
  RewardScale scale = RewardScale::linear;
  double offset = 0, highest = 0, floor = 0;
  double log_jacobian = 0;  // ln |dy/dr|, all rows together
};

Targets logarithmic(const Vector& rewards, double floor, double ceiling) {
  const Vector logs = (rewards.array() + floor).log();
  return {.y = (logs.array() - logs.mean()).matrix(),
          .scale = RewardScale::logarithmic,
          .offset = logs.mean(),
          .highest = logs.maxCoeff() + std::log(ceiling),
          .floor = floor,
          .log_jacobian = -logs.sum()};
}

struct Fitted {
  Targets targets;
  gp::Fit fit;
  double log_evidence() const { return fit.log_evidence + targets.log_jacobian; }
};

Fitted fitted(Targets targets, const gp::Inputs& inputs, const gp::FitOptions& options) {
  gp::Fit fit = gp::fit(inputs, targets.y, options);
  return {std::move(targets), std::move(fit)};
}

Fitted best_fit(const Vector& rewards, const gp::Inputs& inputs, const RewardOptions& options) {
  const double floor = options.floor * rewards.maxCoeff();
  const bool has_logarithm = rewards.minCoeff() >= 0 && floor >= std::numeric_limits<double>::min();
  if (options.scale == RewardScale::linear || !has_logarithm) return fitted({.y = rewards}, inputs, options.fit);
  Fitted logs = fitted(logarithmic(rewards, floor, options.ceiling), inputs, options.fit);
  if (options.scale == RewardScale::logarithmic) return logs;
  Fitted plain = fitted({.y = rewards}, inputs, options.fit);
  const bool logs_likelier = logs.log_evidence() >= plain.log_evidence();  // NaN where a fit failed
  return logs_likelier || std::isnan(plain.log_evidence()) ? logs : plain;
}

/// The way back from the posterior of the targets.
class Believed {
 public:
  Believed(std::shared_ptr<const gp::Posterior> posterior, FeatureMap features, const Targets& targets, double caution)
      : posterior_(std::move(posterior)),
        features_(std::move(features)),
        logarithmic_(targets.scale == RewardScale::logarithmic),
        offset_(targets.offset),
        highest_(targets.highest),
        floor_(targets.floor),
        caution_(caution) {}

  void operator()(const ConstMatrixView&, const ConstMatrixView& U, const ConstMatrixView& X_next,
                  VectorView rewards) const {
    thread_local Matrix inputs;
    thread_local Vector variance;
    inputs.resize(X_next.rows(), features_.features() + U.cols());
    dynamics::gp_inputs(features_, X_next, U, inputs);
    if (!logarithmic_) return posterior_->predict_mean(inputs, rewards);
    variance.resize(X_next.rows());
    posterior_->predict(inputs, rewards, variance);
    rewards = (rewards.array() - caution_ * variance.array() + offset_).min(highest_);
    vector_exp(rewards.data(), rewards.data(), rewards.size());
    rewards.array() -= floor_;
  }

 private:
  std::shared_ptr<const gp::Posterior> posterior_;
  FeatureMap features_;
  bool logarithmic_;
  double offset_, highest_, floor_, caution_;
};

}  // namespace

LearnedReward learn_reward(const Dataset& data, const FeatureMap& features, const RewardOptions& options) {
  const std::vector<Index> rows = dynamics::finite_rows(data.rewards);
  if (rows.empty()) throw InvalidInput("the data set has no row with a finite reward to learn it from");
  const gp::Inputs inputs(
      Matrix(dynamics::gp_inputs(features, data.states + data.changes, data.actions)(rows, Eigen::all)));
  const Fitted best = best_fit(data.rewards(rows), inputs, options);
  LearnedReward learned{.scale = best.targets.scale, .log_evidence = best.log_evidence()};
  if (static_cast<Index>(rows.size()) < data.size())
    learned.notes.push_back(fmt::format("{} rewards are not finite and were left out", data.size() - inputs.size()));
  const auto posterior =
      std::make_shared<gp::Posterior>(inputs, best.targets.y, std::vector{best.fit.hyperparameters}, options.tolerance);
  learned.reward = Believed(posterior, features, best.targets, options.caution);
  return learned;
}

}  // namespace rehearse::identification
