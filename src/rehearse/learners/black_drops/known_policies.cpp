#include "rehearse/learners/black_drops/known_policies.hpp"

namespace rehearse::learners::black_drops {

constexpr double kIncomparable = -kInf;

void History::earn(const Episode& episode, Index horizon) {
  returns.push_back(episode.is_cut_short(horizon) ? kIncomparable : episode.total_reward());
}

std::optional<std::size_t> History::best() const {
  std::optional<std::size_t> best;
  for (std::size_t i = random_first; i < returns.size(); ++i) {
    const bool random = i < policies.size() && policies[i].size() == 0;
    if (!random && returns[i] > (best ? returns[*best] : kIncomparable)) best = i;
  }
  return best;
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
