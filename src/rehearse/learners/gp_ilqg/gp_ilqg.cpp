#include "rehearse/learners/gp_ilqg/gp_ilqg.hpp"

#include <utility>

#include <nlohmann/json.hpp>

#include "rehearse/core/episode_fit.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/stopwatch.hpp"
#include "rehearse/learners/builder.hpp"
#include "rehearse/learners/gp_ilqg/plan_search.hpp"
#include "rehearse/learners/json.hpp"
#include "rehearse/learners/model_of_trials.hpp"
#include "rehearse/learners/prior_faults.hpp"
#include "rehearse/learners/trial_learner.hpp"

namespace rehearse::learners::gp_ilqg {
namespace {

using nlohmann::json;

identification::Kind kind_of(const Options& options) {
  if (options.identify) return options.model;
  return identification::FixedPrior{options.model.gp};
}

class GpIlqg final : public TrialLearner {
 public:
  GpIlqg(Setting setting, const Options& options)
      : setting_(watched(std::move(setting))), options_(options), model_(setting_, kind_of(options)) {}

  void study(const std::vector<Episode>& logs) override { model_.study(logs); }

  json save() const override {
    json state = {{"trials", trials_}, {"plan", plan_ ? to_json(*plan_) : json()}};
    model_.save(state);
    return state;
  }

 private:
  Proposal propose() override { return propose(nullptr); }
  Proposal propose_again(const KnownProposal& known) override { return propose(&known); }

  Proposal propose(const KnownProposal* known) {
    const Task& task = setting_.task;
    Proposal proposal;
    forget_faults(setting_);
    identification::WarmStart start;
    proposal.model_s = seconds([&] { start = model_.learn(proposal); });
    proposal.policy = policy::make_tracking(task, 1 + steps_to_plan(task, options_.search));
    if (known)
      proposal.theta = known->theta;
    else
      proposal.search_s = seconds([&] { search(proposal); });
    proposal.failed_row = fault_of_prior(setting_);
    model_.keep(std::move(start));
    return proposal;
  }

  void search(Proposal& proposal) const {
    const lqr::Problem problem{*proposal.model, setting_.task, *setting_.evaluator};
    const StreamKey stream{.seed = setting_.seed, .trial = trials_ + 1, .phase = setting_.phase};
    if (const auto found = search_plan(problem, options_.search, plan_, stream, setting_.progress)) {
      proposal.theta = found->theta;
      proposal.predicted_return = found->predicted_return;
      proposal.rollouts = found->rollouts;
      proposal.failed_rollouts = found->failed;
      return;
    }
    proposal.notes.emplace_back("no plan is finite in the model: the plan stays");
    proposal.theta = plan_ ? *plan_ : Vector::Zero(proposal.policy->parameters());
    if (!plan_) proposal.rollouts = proposal.failed_rollouts = options_.search.starts;  // nothing that may move a robot
  }

  void learn(const Proposal& tried, const Episode& episode) override {
    require_fit(episode, setting_.task);
    model_.add(episode);
    plan_ = tried.theta;
    ++trials_;
  }

  void restore(const std::vector<Episode>& episodes, const json& state) override {
    model_.restore(episodes, state);
    trials_ = state.at("trials").get<std::uint64_t>();
    plan_.reset();
    if (!state.at("plan").is_null()) plan_ = to_vector(state.at("plan"));
    if (trials_ != episodes.size()) throw InvalidInput("the learner's state does not fit the episodes");
  }

  Setting setting_;
  Options options_;
  ModelOfTrials model_;
  std::uint64_t trials_ = 0;
  std::optional<Vector> plan_;  // of the last trial
};

std::vector<std::string> cannot_do(const Options&, const Task& task, const policy::Policy&) {
  Violations violations;
  violations.require(!task.episode_reward,
                     "the task has a reward of whole episodes ([reward] episode), which gp-ilqg does not plan with: "
                     "choose the learner gp-mi");
  violations.require(task.limits.empty(), "the task has limits, which gp-ilqg does not keep: choose the learner gp-mi");
  violations.require(
      !task.actuators().changes_commands(),
      "the task has max_rate or filter_s of an action, which gp-ilqg does not plan with: choose the learner "
      "gp-mi");
  return violations.list();
}

}  // namespace

std::unique_ptr<Learner> make(Setting setting, Options options) {
  setting = checked(std::move(setting), options, PriorUse::required, cannot_do);
  if (!options.success_test) setting.task.solved = nullptr;
  return std::make_unique<GpIlqg>(std::move(setting), options);
}

std::vector<std::unique_ptr<LearnerBuilder>> builders() {
  return builders_of(Entry<Options>{
      .name = "gp-ilqg",
      .summary = "GPs around the prior, plans by iterative LQG; the policy is feedback that varies with time",
      .prior_use = PriorUse::required,
      .tunes_prior = [](const Options& options) { return options.identify; },
      .make = make,
      .options = {},
      .violations = cannot_do});
}

}  // namespace rehearse::learners::gp_ilqg
