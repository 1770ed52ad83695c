#include "rehearse/learners/black_drops/black_drops.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/episode_fit.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/stopwatch.hpp"
#include "rehearse/learners/black_drops/exploration.hpp"
#include "rehearse/learners/black_drops/hand_over.hpp"
#include "rehearse/learners/black_drops/known_policies.hpp"
#include "rehearse/learners/black_drops/policy_search.hpp"
#include "rehearse/learners/black_drops/trial_search.hpp"
#include "rehearse/learners/builder.hpp"
#include "rehearse/learners/json.hpp"
#include "rehearse/learners/model_of_trials.hpp"
#include "rehearse/learners/prior_faults.hpp"
#include "rehearse/learners/start_policy.hpp"
#include "rehearse/learners/trial_learner.hpp"
#include "rehearse/policy/by_name.hpp"
#include "rehearse/policy/differentiable.hpp"
#include "rehearse/policy/hand_over.hpp"
#include "rehearse/policy/schedule.hpp"

namespace rehearse::learners::black_drops {
namespace {

using nlohmann::json;

constexpr std::uint64_t kLongerSearches = 1 << 15;  // the number of the first: random numbers of their own
constexpr double kMore = 0.05;                      // gain worth a trial, as a fraction of the best return

class BlackDrops final : public TrialLearner {
 public:
  BlackDrops(Setting setting, Options options)
      : setting_(watched(std::move(setting))),
        options_(std::move(options)),
        features_(setting_.task.feature_map()),
        model_(setting_, options_.model, options_.prior_variance) {
    history_.random_first = !setting_.prior && !setting_.start && options_.first_trial.kind != FirstTrial::Kind::policy;
  }

  void study(const std::vector<Episode>& logs) override {
    model_.study(logs);
    history_.random_first = history_.random_first && logs.empty();
  }

  json save() const override {
    json state, policies = json::array();
    model_.save(state);
    for (const Vector& theta : history_.policies) policies.push_back(to_json(theta));
    state["policies"] = policies;
    return state;
  }

 private:
  void learn(const Proposal& tried, const Episode& episode) override {
    require_fit(episode, setting_.task);
    const bool explored = tried.policy->name() == policy::kSchedule && !history_.policies.empty();
    const bool hands_over = tried.policy->name() == policy::kHandOver;
    const Vector theta = hands_over ? tried.theta.head(setting_.policy->parameters()) : tried.theta;
    history_.policies.push_back(explored ? Vector() : theta);
    model_.add(episode);
    history_.earn(episode, setting_.task.horizon);
  }

  void restore(const std::vector<Episode>& episodes, const json& state) override {
    model_.restore(episodes, state);
    history_.returns.clear();
    for (const Episode& episode : episodes) history_.earn(episode, setting_.task.horizon);
    history_.policies = to_vectors(state.at("policies"));
    if (history_.policies.size() != episodes.size())
      throw InvalidInput("the learner's state does not fit the episodes");
  }

  bool without_data() const { return model_.without_data(); }

  Proposal propose() override { return propose(nullptr); }
  Proposal propose_again(const KnownProposal& known) override { return propose(&known); }

  /// known: what was found before for this trial.
  Proposal propose(const KnownProposal* known) {
    Proposal proposal{.policy = setting_.policy};
    if (without_data() && !setting_.prior) {
      propose_without_model(proposal);
      return proposal;
    }
    forget_faults(setting_);
    // The learner's state is assigned last: an interruption must leave none of it behind.
    identification::WarmStart state;
    Task task = setting_.task;
    proposal.model_s = seconds([&] {
      state = model_.learn(proposal);
      if (options_.reward.learned) learn_reward(proposal, task);
    });
    if (known) {
      proposal.policy = policy::by_name(known->policy, known->theta.size(), setting_.task, setting_.policy);
      proposal.theta = known->theta;
    } else
      proposal.search_s = seconds([&] { search(proposal, task); });
    proposal.failed_row = fault_of_prior(setting_);
    model_.keep(std::move(state));
    return proposal;
  }

  void search(Proposal& proposal, const Task& task) const {
    std::optional<policy::HandOver> goal;
    if (options_.search.hand_over) goal = find_goal({*proposal.model, task, *setting_.evaluator}, stream());
    if (options_.search.hand_over && !goal) proposal.notes.emplace_back(kNoGoal);
    const auto handing_over = goal ? policy::with_hand_over(task, setting_.policy, *goal) : setting_.policy;
    const bool at_start = goal && acts_at_start(*goal, task);
    SearchProblem problem = problem_of(proposal, at_start ? *setting_.policy : *handing_over, task);
    if (without_data() && !task.limits.empty())
      problem.doubted = doubted(*setting_.prior, options_.search.safety.doubt, stream());
    const Task longer_task = continued(task, options_.search.extra_s);
    const SearchProblem longer_problem = with_task(problem, longer_task);
    TrialSearches searches(problem, options_.search, stream()),
        longer(longer_problem, options_.search, stream(), kLongerSearches);
    Known known{known_policies(history_, *setting_.policy, options_), history_.policies, without_data()};
    if (setting_.start) known.starts.insert(known.starts.begin(), *setting_.start);
    const bool further = longer_task.horizon > task.horizon;
    Choice choice = search_trial(searches, further ? &longer : nullptr, known, options_);
    bool hands_over = goal && !at_start;
    if (at_start) {
      SearchProblem held = problem_of(proposal, *handing_over, task);
      held.doubted = problem.doubted;
      TrialSearches feedback(held, options_.search, stream());
      hands_over = prefer_feedback(feedback, searches, choice);
      count_rollouts(feedback, proposal);
    }
    if (goal && !hands_over) proposal.notes.emplace_back(kHeldAtStart);
    proposal.theta = hands_over ? policy::to_theta(choice.theta, *goal) : choice.theta;
    if (hands_over) proposal.policy = policy::make_hand_over(setting_.task, setting_.policy);
    proposal.predicted_return = choice.predicted_return;
    // A less safe policy may solve the task where there are limits.
    if (setting_.prior && task.limits.empty() && choice.none_solves && choice.solving == 0)
      proposal.notes.emplace_back(kNoneSolves);
    for (std::string& line : warnings(choice.risks, task.limits)) proposal.notes.push_back(std::move(line));
    proposal.risks = choice.risks;
    count_rollouts(searches, proposal);
    count_rollouts(longer, proposal);
    if (worth_exploring(choice)) explore(problem, proposal);
  }

  static void count_rollouts(const TrialSearches& searches, Proposal& proposal) {
    proposal.rollouts += searches.rollouts();
    proposal.failed_rollouts += searches.failed_rollouts();
  }

  SearchProblem problem_of(const Proposal& proposal, const policy::Policy& policy, const Task& task) const {
    return {*proposal.model, policy, task, *setting_.evaluator, setting_.progress};
  }

  /// The random numbers of this trial.
  StreamKey stream() const {
    return {.seed = setting_.seed, .trial = history_.returns.size() + 1, .phase = setting_.phase};
  }

  void propose_without_model(Proposal& proposal) const {
    if (setting_.start) {
      proposal.theta = *setting_.start;
      return;
    }
    StreamKey episode_stream = stream();
    episode_stream.stage = Stage::episode;
    if (options_.first_trial.kind == FirstTrial::Kind::policy) {
      proposal.theta = random_policy(*setting_.policy, options_.search, episode_stream);
      return;
    }
    const Task& task = setting_.task;
    proposal.policy = policy::make_schedule(task);
    const double fraction = task.limits.empty() ? 1 : options_.first_trial.cautious;
    proposal.theta = smaller_actions(task, random_actions(task, options_.first_trial, episode_stream), fraction);
  }

  /// Without a prior a policy that teaches nothing new would be proposed for ever. A model around a prior knows enough
  /// that a new policy teaches more than small random actions.
  bool worth_exploring(const Choice& choice) const {
    if (setting_.prior || setting_.task.limits.empty() || !options_.search.safety.explore || history_.returns.empty() ||
        !setting_.task.solved)
      return false;
    const double earned = *std::ranges::max_element(history_.returns);
    return choice.excess == 0 && !often_solves(choice) && choice.predicted_return <= earned + kMore * std::abs(earned);
  }

  void explore(const SearchProblem& problem, Proposal& proposal) const {
    const auto random = policy::make_schedule(setting_.task);
    const SearchProblem of_actions{problem.model, *random, problem.task, problem.evaluator, problem.progress};
    SearchResult found = safe_random_actions(of_actions, options_, stream());
    proposal.rollouts += found.rollouts;
    proposal.failed_rollouts += found.failed_rollouts;
    if (found.excess > 0) return;
    proposal.policy = random;
    proposal.theta = std::move(found.theta);
    proposal.predicted_return = found.predicted_return;
    proposal.risks = std::move(found.risks);
    proposal.notes.emplace_back("no policy that is safe promises more than was earned: safe random actions are tried");
  }

  /// Replaces the task's reward by what is believed of it.
  void learn_reward(Proposal& proposal, Task& task) const {
    if (without_data()) {
      task.reward = task.initial_reward;
      return;
    }
    identification::LearnedReward learned = identification::learn_reward(model_.data(), features_, options_.reward);
    task.reward = std::move(learned.reward);
    if (proposal.log_evidence) *proposal.log_evidence += learned.log_evidence;
    for (std::string& note : learned.notes) proposal.notes.push_back(std::move(note));
  }

  Setting setting_;
  Options options_;
  FeatureMap features_;
  ModelOfTrials model_;
  History history_;
};

template <class Kind>
bool is(const Options& options) {
  return std::holds_alternative<Kind>(options.model);
}

PriorUse prior_use(const Options& options) {
  return is<identification::ZeroMean>(options) ? PriorUse::none : PriorUse::required;
}

bool tunes_prior(const Options& options) {
  return is<identification::GpMi>(options) || is<identification::Mi>(options);
}

std::vector<std::string> violations_with(const Options& options, const Task& task, const policy::Policy& policy) {
  Violations violations;
  if (needs_derivatives(options.search.method)) {
    const auto require = [&](bool known, const std::string& of) {
      violations.require(known, "search.method = gradient or polish, but derivatives of " + of +
                                    " are not known: choose search.method = race");
    };
    require(dynamic_cast<const policy::Differentiable*>(&policy) != nullptr, "the policy '" + policy.name() + "'");
    require(!task.actuators().changes_commands(), "commands that are filtered or limited in their rate");
    require(!task.episode_reward, "a reward of whole episodes ([reward] episode)");
  }
  violations.add(hand_over_violations(options.search, task));
  if (options.reward.learned) {
    violations.require(!task.episode_reward,
                       "reward.learned = true, but a reward of whole episodes ([reward] episode) is not learned: leave "
                       "out one of them");
    violations.require(
        prior_use(options) == PriorUse::none || task.initial_reward,
        "reward.learned = true, but the robot has no guess of the reward for the first search, on the prior: set "
        "initial_reward_width, which some built-in robots have, or choose a learner without a prior");
  }
  return violations.list();
}

Entry<Options> entry(const char* name, const char* summary, identification::Kind model) {
  Options options{.model = std::move(model)};
  if (prior_use(options) == PriorUse::none) options.search.simulate.noise_clip = 0, options.search.safety.caution = 3;
  return {.name = name,
          .summary = summary,
          .prior_use = prior_use(options),
          .chooses_priors = tunes_prior(options),
          .takes_start = true,
          .tunes_prior = tunes_prior,
          .make = make,
          .options = options,
          .violations = violations_with};
}

/// Removes the reward, the cost and the test of success from the task of a learner that learns the reward.
void forget_reward(Task& task) {
  task.reward = nullptr;
  task.cost = nullptr;
  task.solved = nullptr;
}

}  // namespace

std::unique_ptr<Learner> make(Setting setting, Options options) {
  setting = checked(std::move(setting), options, prior_use(options), violations_with);
  require_start_in_box(setting, options.search.box, "search.box");
  if (options.reward.learned) forget_reward(setting.task);
  if (!options.success_test) setting.task.solved = nullptr;
  if (!setting.task.limits.empty()) options.search.simulate.noise_clip = 0;  // or a model that errs seems to be safe
  return std::make_unique<BlackDrops>(std::move(setting), std::move(options));
}

std::vector<std::unique_ptr<LearnerBuilder>> builders() {
  return builders_of(
      entry("black-drops", "GPs from data alone; the first trial is random actions", identification::ZeroMean{}),
      entry("black-drops-prior", "GPs around the prior as it is given", identification::FixedPrior{}),
      entry("gp-mi", "GPs around the prior, its parameters identified together with the GPs", identification::GpMi{}),
      entry("mi", "the prior's parameters identified from data, no GP", identification::Mi{}));
}

}  // namespace rehearse::learners::black_drops
