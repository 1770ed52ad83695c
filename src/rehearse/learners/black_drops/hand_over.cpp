#include "rehearse/learners/black_drops/hand_over.hpp"

#include "rehearse/core/errors.hpp"
#include "rehearse/lqr/linear_steps.hpp"

namespace rehearse::learners::black_drops {

std::optional<policy::HandOver> find_goal(const lqr::Problem& problem, StreamKey trial) {
  trial.stage = Stage::goal;
  trial.purpose = Purpose::states;
  return lqr::find_goal(problem, trial);
}

bool acts_at_start(const policy::HandOver& goal, const Task& task) {
  const Vector apart = task.difference(task.start_mean, goal.feedback.state);
  return apart.dot(goal.shape * apart) < 1;
}

bool prefer_feedback(TrialSearches& feedback, TrialSearches& searches, Choice& choice) {
  SearchResult with = feedback.judge(choice.theta), without = searches.judge(choice.theta);
  with.solving = feedback.compare_solving({choice.theta})(0);
  without.solving = searches.compare_solving({choice.theta})(0);
  const bool decided = with.excess == without.excess && with.solving != without.solving;
  if (decided ? with.solving < without.solving : better(without, with)) return false;
  choice.take(with);
  return true;
}

std::vector<std::string> hand_over_violations(const SearchOptions& options, const Task& task) {
  if (!options.hand_over) return {};
  Violations violations;
  violations.require(!needs_derivatives(options.method),
                     "search.hand_over = true, but search.method = gradient or polish needs derivatives of the whole "
                     "policy: choose search.method = race");
  violations.require(!task.actuators().changes_commands(),
                     "search.hand_over = true, but commands are filtered or limited in their rate, which the feedback "
                     "does not know: leave out one of them");
  return violations.list();
}

}  // namespace rehearse::learners::black_drops
