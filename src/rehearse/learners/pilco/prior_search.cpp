#include "rehearse/learners/pilco/prior_search.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rehearse/learners/pilco/initial_policy.hpp"
#include "rehearse/learners/pilco/prior_store.hpp"

namespace rehearse::learners::pilco {
namespace {

/// The knowledge kept in the store; empty if there is none, or none that fits.
PriorKnowledge kept_policies(const Setting& setting) {
  const auto work = kept_work(setting);
  if (!work) return {};
  try {
    PriorKnowledge knowledge = to_knowledge(*work);
    for (const Vector& theta : knowledge.policies)
      if (theta.size() != setting.policy->parameters()) return {};
    return knowledge;
  } catch (const std::exception&) {
    return {};
  }
}

/// The search number `number`, from 0 on, and what it adds.
void search_once(const SearchProblem& problem, const SearchOptions& options, StreamKey key, PriorKnowledge& knowledge) {
  key.candidate = static_cast<std::uint64_t>(knowledge.policies.size());
  const Vector first = initial_policy(problem.policy, start_state(problem.task, options), key);
  const SearchResult found = search_policy(problem, first, options);
  if (knowledge.policies.empty() || found.predicted_return > knowledge.predicted_return) {  // none is less than any
    knowledge.theta = found.theta;
    knowledge.predicted_return = found.predicted_return;
  }
  knowledge.policies.push_back(found.theta);
  knowledge.evaluations += found.evaluations;
  knowledge.failed += found.failed;
}

}  // namespace

PriorKnowledge search_on_prior(const Setting& setting, const Options& options) {
  const Task& task = setting.task;
  const std::size_t searches = static_cast<std::size_t>(options.pi_rem->searches);
  PriorKnowledge knowledge = kept_policies(setting);
  ProgressSink progress;
  if (setting.progress)
    progress = [&](Progress of_search) {
      of_search.phase = fmt::format("prior {}/{}: {}", knowledge.policies.size(), searches, of_search.phase);
      setting.progress(of_search);
    };
  const moments::StepDynamics prior(
      nullptr, moments::make_prior_moments(*setting.prior, setting.prior->space.values(), task.state_size(),
                                           task.action_size(), options.pi_rem->through));
  const SearchProblem problem{prior, *setting.policy, task, *setting.evaluator, progress};
  SearchOptions search = options.search;
  search.start_std = std::max(search.start_std, options.pi_rem->start_std);
  const StreamKey key{.seed = setting.seed, .trial = 1, .phase = Phase::prior, .stage = Stage::search};
  while (knowledge.policies.size() < searches) {
    search_once(problem, search, key, knowledge);
    if (knowledge.policies.size() == searches && !knowledge.predicted_return)
      knowledge.notes.emplace_back("the first policy is as drawn: none had an expected return on the prior");
    keep_work(setting, to_json(knowledge));
  }
  return knowledge;
}

}  // namespace rehearse::learners::pilco
