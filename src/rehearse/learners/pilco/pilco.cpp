#include "rehearse/learners/pilco/pilco.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/stopwatch.hpp"
#include "rehearse/gp/moment_kernel.hpp"
#include "rehearse/learners/json.hpp"
#include "rehearse/policy/schedule.hpp"

namespace rehearse::learners::pilco {
namespace {

using nlohmann::json;

class Pilco final : public Learner {
 public:
  Pilco(Setting setting, Options options) : setting_(std::move(setting)), options_(std::move(options)) {}

  const Proposal& ask() override {
    if (!proposal_) proposal_ = propose();
    return *proposal_;
  }

  void tell(const Episode& episode) override {
    if (const Proposal& asked = ask(); trials_ > 0) theta_ = asked.theta;
    data_.append(episode);
    ++trials_;
    proposal_.reset();
  }

  json save() const override {
    json kernels = json::array();
    for (const auto& kernel : kernels_) kernels.push_back(to_json(kernel.flat()));
    return {{"trials", trials_}, {"kernels", kernels}, {"theta", to_json(theta_)}};
  }

  void load(const std::vector<Episode>& episodes, const json& state) override {
    data_ = {};
    kernels_.clear();
    proposal_.reset();
    for (const Episode& episode : episodes) data_.append(episode);
    for (const json& flat : state.at("kernels")) kernels_.push_back(gp::Hyperparameters::from_flat(to_vector(flat)));
    theta_ = to_vector(state.at("theta"));
    trials_ = state.at("trials").get<std::uint64_t>();
    if (trials_ != episodes.size()) throw InvalidInput("the learner's state does not fit the episodes");
  }

 private:
  std::uint64_t trial() const { return trials_ + 1; }

  Proposal propose() {
    if (trials_ == 0) return random_actions();
    Proposal proposal{.policy = setting_.policy};
    Model model;
    proposal.model_s = seconds([&] { model = learn_model(); });
    proposal.model = model.model;
    proposal.notes = std::move(model.notes);
    if (std::isfinite(model.log_evidence)) proposal.log_evidence = model.log_evidence;
    proposal.theta = theta_.size() > 0
                         ? theta_
                         : initial_policy(*setting_.policy, setting_.task, options_.search, setting_.seed, trial());
    if (model.moments) proposal.search_s = seconds([&] { search(model, proposal); });
    kernels_ = std::move(model.kernels);  // last: an interruption must not leave it behind
    return proposal;
  }

  Proposal random_actions() const {
    const Task& task = setting_.task;
    return {.policy = policy::make_schedule(task.action_bounds(), task.dt_s, task.horizon),
            .theta = policy::random_schedule(task, policy::RandomActions::uniform, options_.first_trial_hold_s,
                                             setting_.seed, trial())};
  }

  Model learn_model() const {
    if (setting_.progress) setting_.progress({.phase = "model"});
    return learn(setting_.task, data_, options_.model, kernels_, *setting_.evaluator);
  }

  /// From the proposal's θ.
  void search(const Model& model, Proposal& proposal) const {
    SearchResult found =
        search_policy({model.moments, *setting_.policy, setting_.task, *setting_.evaluator, setting_.progress},
                      proposal.theta, options_.search);
    proposal.theta = std::move(found.theta);
    proposal.predicted_return = found.predicted_return;
    proposal.rollouts = found.evaluations;
    proposal.failed_rollouts = found.failed;
    if (!found.predicted_return)
      proposal.notes.emplace_back("the policy stays: its expected return on the model could not be computed");
  }

  Setting setting_;
  Options options_;
  Dataset data_;
  std::uint64_t trials_ = 0;
  Vector theta_;  // of the last trial; empty before the second
  std::vector<gp::Hyperparameters> kernels_;
  std::optional<Proposal> proposal_;
};

std::vector<std::string> without_moments(const Task& task, const policy::Policy& policy) {
  Violations violations;
  violations.require(policy.analytic() != nullptr,
                     fmt::format("policy = {} has no analytic moments, which pilco needs: choose policy = rbf "
                                 "(--set policy=rbf), or the learner black-drops",
                                 policy.name()));
  violations.require(task.saturating_reward.has_value(),
                     "the scenario's reward has no analytic moments, which pilco needs: give the task a "
                     "saturating_reward, or choose the learner black-drops");
  const Index inputs = task.feature_map().features() + task.action_size();
  violations.require(inputs <= gp::kMostMomentInputs,
                     fmt::format("{} features and actions, pilco takes at most {}: choose the learner black-drops",
                                 inputs, gp::kMostMomentInputs));
  return violations.list();
}

class Builder final : public LearnerBuilder {
 public:
  std::string name() const override { return "pilco"; }
  std::string summary() const override {
    return "GPs from data alone, policies by moment matching and its gradient; needs policy=rbf";
  }
  PriorUse prior_use() const override { return PriorUse::none; }
  bool chooses_priors() const override { return false; }
  void fields(FieldVisitor& v) override { options_.fields(v); }
  std::vector<std::string> violations(const Task& task, const policy::Policy& policy) const override {
    return without_moments(task, policy);
  }
  std::unique_ptr<Learner> build(Setting setting) const override { return make(std::move(setting), options_); }

 private:
  Options options_;
};

}  // namespace

void Options::fields(FieldVisitor& v) {
  v.group("model", model);
  v.group("search", search);
  v.number("first_trial.hold_s", first_trial_hold_s, at_least(0));
}

std::unique_ptr<Learner> make(Setting setting, Options options) {
  Violations violations;
  for (const auto& line : field_violations([&](FieldVisitor& v) { options.fields(v); })) violations.add(line);
  for (const auto& line : setting.task.violations()) violations.add(line);
  violations.require(static_cast<bool>(setting.policy), "this learner needs a policy");
  if (setting.policy)
    for (const auto& line : without_moments(setting.task, *setting.policy)) violations.add(line);
  violations.throw_if_any();
  if (!setting.evaluator) setting.evaluator = make_thread_evaluator(1);
  return std::make_unique<Pilco>(std::move(setting), std::move(options));
}

std::vector<std::unique_ptr<LearnerBuilder>> builders() {
  std::vector<std::unique_ptr<LearnerBuilder>> all;
  all.push_back(std::make_unique<Builder>());
  return all;
}

}  // namespace rehearse::learners::pilco
