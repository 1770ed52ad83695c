#include <cmath>

#include "rehearse/optim/box.hpp"
#include "rehearse/optim/derivative_free.hpp"
#include "rehearse/optim/nlopt_search.hpp"

namespace rehearse::optim {
namespace {

ScalarResult search_once(const ScalarObjective& objective, const Vector& start, const std::vector<Interval>& box,
                         const SubplexOptions& options, Index max_evaluations) {
  Vector low(start.size()), high(start.size());
  for (Index i = 0; i < start.size(); ++i) {
    low(i) = box[static_cast<std::size_t>(i)].low;
    high(i) = box[static_cast<std::size_t>(i)].high;
  }
  NloptSearch search(NLOPT_LN_SBPLX, objective, low, high);
  const Vector first = options.first_step * (high - low);
  nlopt_set_initial_step(search.settings(), first.data());
  nlopt_set_xtol_rel(search.settings(), options.x_tolerance);
  nlopt_set_ftol_rel(search.settings(), options.value_tolerance);
  search.maximise(start, max_evaluations);
  return {search.best_x, search.best_value, search.evaluations, search.stop};
}

}  // namespace

ScalarResult maximise_subplex(const ScalarObjective& objective, const Vector& start, const std::vector<Interval>& box,
                              const SubplexOptions& options) {
  require_searchable(start, box, field_violations("subplex", options));
  ScalarResult best = search_once(objective, start, box, options, options.max_evaluations);
  while (options.repeat && best.evaluations < options.max_evaluations) {
    ScalarResult next = search_once(objective, best.x, box, options, options.max_evaluations - best.evaluations);
    next.evaluations += best.evaluations;
    const bool settled = !(next.value - best.value > options.value_tolerance * std::abs(best.value));
    best = std::move(next);
    if (settled) break;
  }
  return best;
}

std::vector<Vector> combinations(const std::vector<std::vector<double>>& choices) {
  std::vector<Vector> all{Vector(0)};
  for (const auto& set : choices) {
    std::vector<Vector> longer;
    for (const Vector& head : all)
      for (const double value : set) {
        longer.emplace_back(head.size() + 1);
        longer.back() << head, value;
      }
    all = std::move(longer);
  }
  return all;
}

}  // namespace rehearse::optim
