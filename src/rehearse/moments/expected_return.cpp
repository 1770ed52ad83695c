#include "rehearse/moments/expected_return.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/moments/analytic_policy.hpp"
#include "rehearse/moments/requirements.hpp"
#include "rehearse/moments/saturating_moments.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/policy/rbf.hpp"

namespace rehearse::moments {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// The features that are inputs of the GPs: with joint angles if their number of inputs says so.
FeatureMap features_of(const Task& task, const StepDynamics& dynamics) {
  if (!dynamics) throw InvalidInput("dynamics: there are none");
  FeatureMap with_joints = model_features(task, true);
  return dynamics.gps && dynamics.gps->inputs() == with_joints.features() + task.action_size() ? with_joints
                                                                                               : task.feature_map();
}

/// The features that policy and reward see.
Gaussian seen(const Transformed& features, Index count) {
  return {features.mean.head(count), features.covariance.topLeftCorner(count, count)};
}

void check(const Task& task, const policy::Policy& policy, const StepDynamics& dynamics, const Gaussian& start) {
  Violations violations;
  violations.require(analytic_options(policy).has_value(),
                     fmt::format("policy = {}: its actions have no analytic moments, must be rbf, or linear with a "
                                 "sine as squash",
                                 policy.name()));
  const reward::ClosedForm* reward = reward::closed_form(task.reward);
  violations.require(reward != nullptr,
                     "the task's reward has no analytic moments: it must be a saturating one of distances that are "
                     "linear in the features (reward::ClosedForm)");
  violations.require(!task.cost, "the task has a cost of steps, whose moments are not known");
  violations.require(!task.episode_reward, "the task has a reward of whole episodes, whose moments are not known");
  const Index features = task.feature_map().features(), states = task.state_size();
  if (reward)
    violations.require(reward->goal.size() == features && reward->distances.cols() == features &&
                           reward->goal.allFinite() && reward->distances.allFinite(),
                       fmt::format("closed form of the reward: of {} and {} features, must be of {} and finite",
                                   reward->goal.size(), reward->distances.cols(), features));
  if (const auto analytic = analytic_options(policy)) {
    const Index seen = std::visit([](const auto* options) { return options->scale.size(); }, *analytic);
    violations.require(seen == features && policy.actions() == task.action_size(),
                       fmt::format("policy = {}: {} features and {} actions, the task has {} and {}", policy.name(),
                                   seen, policy.actions(), features, task.action_size()));
  }
  const Index inputs = features + task.action_size();
  const Index with_joints = model_features(task, true).features() + task.action_size();
  if (const auto& gps = dynamics.gps)
    violations.require(
        (gps->inputs() == inputs || gps->inputs() == with_joints) && gps->outputs() == states,
        fmt::format("dynamics: {} inputs and {} outputs, must be {}{} and {}", gps->inputs(), gps->outputs(), inputs,
                    with_joints > inputs ? fmt::format(" (with joint angles {})", with_joints) : "", states));
  if (const auto& prior = dynamics.prior)
    violations.require(prior->states() == states && prior->actions() == task.action_size(),
                       fmt::format("prior: {} states and {} actions, must be {} and {}", prior->states(),
                                   prior->actions(), states, task.action_size()));
  violations.require(start.size() == states && start.covariance.rows() == states && start.covariance.cols() == states,
                     fmt::format("start: {} states, must be {}", start.size(), states));
  violations.require(task.horizon >= 1, fmt::format("horizon = {}, must be ≥ 1", task.horizon));
  violations.throw_if_any();
}

/// Rounding may leave a variance below zero.
Vector deviations(const ConstVectorView& variances) {
  return variances.unaryExpr([](double variance) { return std::sqrt(std::max(variance, 0.0)); });
}

Gaussian start_of(const Task& task) { return {task.start_mean, Matrix(task.start_std.cwiseAbs2().asDiagonal())}; }

}  // namespace

bool Return::ok() const { return std::isfinite(value); }

ExpectedReturn::ExpectedReturn(const Task& task, const policy::Policy& policy, StepDynamics dynamics,
                               std::optional<Gaussian> start)
    : dynamics_(std::move(dynamics)),
      features_(features_of(task, dynamics_)),
      start_(start ? std::move(*start) : start_of(task)),
      horizon_(task.horizon) {
  check(task, policy, dynamics_, start_);
  policy_ = policy_moments(policy);
  reward_ = *reward::closed_form(task.reward);
}

bool ExpectedReturn::roll_out(const PolicyMoments& policy, ReturnWorkspace& workspace, Return& result,
                              const Evaluator& evaluator) const {
  const Propagation propagation(dynamics_, policy, evaluator);
  workspace.states.resize(at(horizon_ + 1)), workspace.features.resize(at(horizon_ + 1));
  workspace.steps.resize(at(horizon_));
  workspace.states[0] = start_;
  workspace.features[0] = features_(start_);
  for (Index t = 0; t < horizon_; ++t, ++result.steps) {
    Gaussian& next = workspace.states[at(t + 1)];
    if (!propagation.forward(workspace.states[at(t)], workspace.features[at(t)], workspace.steps[at(t)], next))
      return false;
    Transformed& f = workspace.features[at(t + 1)];
    f = features_(next);
    const RewardMoments moments = saturating_moments(reward_, seen(f, reward_.goal.size()));
    if (!std::isfinite(moments.mean)) return false;
    result.rewards(t) = moments.mean;
    result.variances(t) = moments.variance;
  }
  return true;
}

Vector ExpectedReturn::differentiate(const PolicyMoments& policy, ReturnWorkspace& workspace,
                                     const Evaluator& evaluator) const {
  if (dynamics_.prior) {  // all steps at once
    std::vector<PriorTape*> tapes;
    for (StepTape& step : workspace.steps) tapes.push_back(&step.prior);
    if (!dynamics_.prior->differentiate(tapes)) return {};
  }
  const Propagation propagation(dynamics_, policy, evaluator);
  PolicyAdjoint adjoint = policy.zero_adjoints();
  const Index dx = start_.size();
  Gaussian later = Gaussian::zero(dx);  // the adjoint of x_{t+1} by what comes after its reward
  Transformed features_later = Transformed::zero(dx, workspace.features[0].outputs());
  for (Index t = horizon_ - 1; t >= 0; --t) {
    const Transformed& f = workspace.features[at(t + 1)];
    const Index rewarded = reward_.goal.size();
    const RewardMoments moments = saturating_moments(reward_, seen(f, rewarded));
    features_later.mean.head(rewarded) += moments.by_mean.mean;
    features_later.covariance.topLeftCorner(rewarded, rewarded) += moments.by_mean.covariance;
    features_.adjoint(workspace.states[at(t + 1)], f, features_later, later);
    Gaussian state = Gaussian::zero(dx);
    features_later = Transformed::zero(dx, f.outputs());
    propagation.adjoint(workspace.states[at(t)], workspace.features[at(t)], workspace.steps[at(t)], later,
                        {state, features_later, adjoint});
    later = std::move(state);
  }
  return policy.gradient(adjoint);
}

Return ExpectedReturn::operator()(const ConstVectorView& theta, Vector* gradient, ReturnWorkspace& workspace,
                                  const Evaluator& evaluator) const {
  Return result{
      .value = kNaN, .rewards = Vector::Constant(horizon_, kNaN), .variances = Vector::Constant(horizon_, kNaN)};
  if (gradient) gradient->setConstant(theta.size(), kNaN);
  const auto policy = policy_(theta);
  if (!policy->ok() || !roll_out(*policy, workspace, result, evaluator)) return result;
  if (gradient) {
    *gradient = differentiate(*policy, workspace, evaluator);
    if (gradient->size() == 0 || !gradient->allFinite()) {
      gradient->setConstant(theta.size(), kNaN);
      return result;
    }
  }
  result.value = result.rewards.sum();
  return result;
}

ExpectedEpisode ExpectedReturn::episode(const ConstVectorView& theta, const Evaluator& evaluator) const {
  ReturnWorkspace workspace;
  const Return result = (*this)(theta, nullptr, workspace, evaluator);
  ExpectedEpisode episode = ExpectedEpisode::unknown(horizon_, start_.size());
  episode.rewards = result.rewards;
  episode.reward_deviations = deviations(result.variances);
  for (Index t = 0; t <= result.steps; ++t) {
    const Gaussian& state = t == 0 ? start_ : workspace.states[at(t)];
    episode.states.row(t) = state.mean.transpose();
    episode.state_deviations.row(t) = deviations(state.covariance.diagonal()).transpose();
  }
  return episode;
}

std::function<ExpectedEpisode()> expected_episode(Task task, std::shared_ptr<const policy::Policy> policy,
                                                  MakeMoments dynamics, Vector theta) {
  return [task = std::move(task), policy = std::move(policy), dynamics = std::move(dynamics),
          theta = std::move(theta)] { return ExpectedReturn(task, *policy, dynamics()).episode(theta); };
}

}  // namespace rehearse::moments
