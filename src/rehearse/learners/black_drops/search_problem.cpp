#include "rehearse/learners/black_drops/search_problem.hpp"

#include <algorithm>

namespace rehearse::learners::black_drops {

void SearchOptions::fields(FieldVisitor& v) {
  v.choice("method", method,
           "CMA-ES with competing runs (race) or restarts; gradient ascent; polish: race, then gradient ascent",
           {"race", "restarts", "gradient", "polish"}, published("restarts"));
  v.number("box", box, "policy parameters are searched in [−box, box], unless the policy has bounds of its own",
           between(1e-6, 1e6));
  v.integer("particles", particles, "rollouts of one evaluation", between(1, 1e6));
  v.group("simulate", simulate);
  v.group("race", race);
  v.group("restarts", restarts, kExpert);
  v.group("gradient", gradient);
  v.integer("finalists", finalists, "number of best policies that are compared once more at the end", between(1, 1e6),
            published(1));
  v.integer("selection", selection, "rollouts of each finalist; their mean is the predicted return", between(1, 1e6),
            published(1));
  v.group("safety", safety);
}

Index comparisons(const SearchProblem& problem, const SearchOptions& options) {
  if (!problem.task.limits.empty()) return std::max(options.selection, options.safety.rollouts);
  const bool sure = !options.simulate.sample || problem.model.certain();
  const bool exact = options.simulate.measurement_noise == 0 || problem.model.measurement_std().isZero(0);
  return sure && exact && problem.task.start_std.isZero(0) ? 1 : options.selection;
}

}  // namespace rehearse::learners::black_drops
