#include "rehearse/learners/black_drops/moments.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/gp/posterior.hpp"
#include "rehearse/moments/requirements.hpp"

namespace rehearse::learners::black_drops {
namespace {

constexpr const char* kWho = "search.evaluation = moments";
constexpr const char* kOtherwise = "search.evaluation = samples";

void check_model(const dynamics::GpOptions& gp, const Task& task, Violations& violations) {
  const auto refuse = [&](bool wrong, const char* what, const char* instead) {
    violations.require(!wrong, fmt::format("{} has no analytic moments, which {} needs: choose {}, or {}", what, kWho,
                                           instead, kOtherwise));
  };
  refuse(gp.fit.trend, "model.gp.trend = true", "model.gp.trend = false");
  refuse(gp.integrate_rates && !task.kinematics().pairs.empty(), "model.gp.integrate_rates = true",
         "model.gp.integrate_rates = false");
  refuse(gp.smooth, "model.gp.smooth = true", "model.gp.smooth = false");
  refuse(gp.variance == dynamics::PredictedVariance::noisy, "model.gp.variance = noisy", "model.gp.variance = latent");
}

bool joint_angles(const Options& options) {
  const auto* zero_mean = std::get_if<identification::ZeroMean>(&options.model);
  return zero_mean && zero_mean->gp.joint_angles;
}

}  // namespace

std::vector<std::string> without_moments(const Options& options, const Task& task, const policy::Policy& policy) {
  Violations violations;
  if (const auto* zero_mean = std::get_if<identification::ZeroMean>(&options.model))
    check_model(zero_mean->gp, task, violations);
  else
    violations.add(fmt::format(
        "a model around a simulator has no analytic moments, which {} needs: choose {}, or the learner black-drops or "
        "pilco-prior",
        kWho, kOtherwise));
  violations.require(!options.reward.learned,
                     fmt::format("reward.learned = true has no analytic moments, which {} needs: choose "
                                 "reward.learned = false, or {}",
                                 kWho, kOtherwise));
  violations.require(
      std::ranges::all_of(task.model_features().targets(), [](Index state) { return state < 0; }),
      fmt::format("an action that is the target of a state has no analytic moments, which {} needs: choose {}", kWho,
                  kOtherwise));
  for (const std::string& line : moments::without_moments(task, policy, {kWho, kOtherwise, joint_angles(options)}))
    violations.add(line);
  return violations.list();
}

std::shared_ptr<const moments::MomentMatching> moments_of(const Options& options, const Task& task, const Dataset& data,
                                                          const std::vector<gp::Hyperparameters>& kernels) {
  const FeatureMap features = moments::model_features(task, joint_angles(options));
  const gp::Inputs inputs(dynamics::gp_inputs(features, data.states, data.actions));
  return std::make_shared<moments::MomentMatching>(moments::exact_terms(gp::Posterior(inputs, data.changes, kernels)),
                                                   task.state_size());
}

}  // namespace rehearse::learners::black_drops
