#include "rehearse/learners/black_drops/known_policies.hpp"

#include <algorithm>

namespace rehearse::learners::black_drops {

std::optional<std::size_t> History::best() const {
  const auto first = returns.begin() + (random_first && !returns.empty());
  if (first == returns.end()) return std::nullopt;
  return static_cast<std::size_t>(std::max_element(first, returns.end()) - returns.begin());
}

std::vector<Vector> known_policies(const History& history, const policy::Policy& policy, const Options& options) {
  std::vector<Vector> known;
  const auto best = history.best();
  if (options.start_from_best && best) known.push_back(history.policies[*best]);
  if (!options.start_from_examples) return known;
  const Matrix examples = policy.examples();
  for (const auto& example : examples.rowwise()) known.emplace_back(example.transpose());
  return known;
}

}  // namespace rehearse::learners::black_drops
