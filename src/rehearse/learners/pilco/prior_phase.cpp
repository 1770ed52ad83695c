#include "rehearse/learners/pilco/prior_phase.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
#include "rehearse/learners/json.hpp"
#include "rehearse/learners/pilco/prior_store.hpp"
#include "rehearse/learners/pilco/trials.hpp"
#include "rehearse/rollout/execute.hpp"

namespace rehearse::learners::pilco {
namespace {

using nlohmann::json;

/// The state of the phase.
struct State {
  PriorKnowledge knowledge;  // its counts and notes so far; all of it once the phase is over
  bool over = false;         // the rest no longer matters
  Index settled = 0;         // episodes in a row that taught nothing
  std::vector<Episode> episodes;
  json learner;
};

json to_work(const State& state) {
  json all = {{"knowledge", to_json(state.knowledge)}, {"over", state.over}};
  if (!state.over) {
    all["learner"] = state.learner;
    all["settled"] = state.settled;
    for (const Episode& episode : state.episodes) all["episodes"].push_back(learners::to_json(episode));
  }
  return all;
}

State to_state(const json& all) {
  State state{.knowledge = to_knowledge(all.at("knowledge")), .over = all.at("over").get<bool>()};
  if (state.over) return state;
  state.learner = all.at("learner");
  state.settled = all.at("settled").get<Index>();
  for (const json& episode : all.at("episodes")) state.episodes.push_back(to_episode(episode));
  return state;
}

class PriorPhase {
 public:
  PriorPhase(const Setting& setting, const Options& options)
      : setting_(with_evaluator(setting)),
        options_(options.prior.value()),
        trials_(inner_setting(), inner_options(options)) {}
  PriorPhase(const PriorPhase&) = delete;  // the progress of its trials points here
  PriorPhase& operator=(const PriorPhase&) = delete;

  PriorKnowledge run() {
    restore();
    if (state_.over) return state_.knowledge;
    while (!knows_enough()) one_episode();
    require_steps();
    const Proposal& last = asked();
    PriorKnowledge& knowledge = state_.knowledge;
    knowledge.network = moments::mean_terms(trials_.terms(options_.inducing, knowledge.notes));
    knowledge.theta = last.theta;
    knowledge.predicted_return = last.predicted_return;
    state_.over = true;
    keep();
    return knowledge;
  }

 private:
  static Setting with_evaluator(Setting setting) {
    if (!setting.evaluator) setting.evaluator = make_thread_evaluator(1);
    return setting;
  }
  Setting inner_setting() {
    Setting inner = setting_;
    inner.prior.reset();
    inner.store.reset();
    inner.phase = Phase::prior;
    if (setting_.progress) inner.progress = [this](const Progress& progress) { report(progress); };
    return inner;
  }
  static Options inner_options(Options options) {
    options.prior.reset();
    options.model.smooth = false;  // episodes on the prior are measured without noise
    return options;
  }

  Index done() const { return static_cast<Index>(state_.episodes.size()); }
  bool knows_enough() const {
    return done() >= options_.episodes || (options_.settled > 0 && state_.settled >= options_.settled);
  }

  void report(Progress progress) const {
    progress.phase = fmt::format("prior {}/{}: {}", done(), options_.episodes, progress.phase);
    setting_.progress(progress);
  }

  void restore() {
    const auto work = kept_work(setting_);
    if (!work) return;
    const json fresh = trials_.save();
    try {
      State state = to_state(*work);
      if (!state.over) trials_.load(state.episodes, state.learner);
      state_ = std::move(state);
    } catch (const std::exception&) {  // not one of ours: as if nothing had been kept
      trials_.load({}, fresh);
    }
  }

  void keep() const { keep_work(setting_, to_work(state_)); }

  void one_episode() {
    const Proposal& proposal = asked();
    const StreamKey key{.seed = setting_.seed,
                        .trial = static_cast<std::uint64_t>(done()) + 1,
                        .phase = Phase::prior,
                        .purpose = Purpose::start_state};
    const prior::Prior& prior = *setting_.prior;
    const Episode episode = rollout::execute({prior.simulator, prior.space.values()}, *proposal.policy, proposal.theta,
                                             setting_.task, Rng(key), [&] { setting_.evaluator->stop_if_asked(); });
    note_failure(episode);
    state_.settled = taught_nothing(proposal, episode) ? state_.settled + 1 : 0;
    trials_.tell(episode);
    state_.episodes.push_back(episode);
    state_.learner = trials_.save();
    keep();
  }

  /// Moment matching may promise less than a policy earns, and go on doing so.
  bool taught_nothing(const Proposal& proposal, const Episode& episode) const {
    if (!proposal.predicted_return) return false;
    const double earned = episode.total_reward(), promised = *proposal.predicted_return;
    const bool keeps_promise = earned >= (1 - kSameReturn) * promised;
    return keeps_promise && std::ranges::any_of(state_.episodes, [&](const Episode& before) {
             return earned <= (1 + kSameReturn) * before.total_reward();
           });
  }

  void note_failure(const Episode& episode) {
    if (episode.failure.empty()) return;
    state_.knowledge.notes.push_back(fmt::format("on the prior, episode {}: {}", done() + 1, episode.failure));
  }

  /// A prior that cannot make one step says nothing of the robot: what follows would be a policy as drawn.
  void require_steps() const {
    if (std::ranges::any_of(state_.episodes, [](const Episode& episode) { return episode.steps() > 0; })) return;
    throw std::runtime_error(
        fmt::format("none of {} episodes on the prior has a step: {}. No policy was learned that "
                    "could move the robot",
                    done(), state_.episodes.back().failure));
  }

  const Proposal& asked() {
    const Proposal& proposal = trials_.ask();
    state_.knowledge.evaluations += proposal.rollouts;
    state_.knowledge.failed += proposal.failed_rollouts;
    for (const std::string& note : proposal.notes)
      state_.knowledge.notes.push_back(fmt::format("on the prior, after {} episodes: {}", done(), note));
    return proposal;
  }

  Setting setting_;
  PriorPhaseOptions options_;
  State state_;
  Trials trials_;
};

}  // namespace

PriorKnowledge learn_on_prior(const Setting& setting, const Options& options) {
  return PriorPhase(setting, options).run();
}

}  // namespace rehearse::learners::pilco
