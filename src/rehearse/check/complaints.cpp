#include "rehearse/check/complaints.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace rehearse::check {

std::vector<std::string> complaints(const Tried& tried) {
  std::vector<std::string> lines = tried.broken;
  if (tried.end) lines.push_back(*tried.end);
  for (const PriorTried& prior : tried.priors) {
    const bool fails = tried.steps > 0 && prior.failed == tried.steps;
    for (const std::string& name : fails ? std::vector<std::string>() : prior.idle)
      lines.push_back(fmt::format(
          "prior {}: {} changes no prediction on the {} states tried, so it cannot be learned; is its name right "
          "where it is used? If it acts farther off alone, let [[state]] start or start_noise lead there; `learn` "
          "takes it all the same",
          prior.name, name, prior.states));
    if (!prior.broken.empty()) lines.push_back(fmt::format("prior {}: {}", prior.name, prior.broken));
    if (fails)
      lines.push_back(
          fmt::format("prior {}: none of {} rows has a prediction; is dt_s in seconds?", prior.name, tried.steps));
  }
  return lines;
}

bool has_notes(const Tried& tried) {
  return !tried.notes.empty() || std::ranges::any_of(tried.priors, [](const PriorTried& prior) {
    return prior.failed > 0 || !prior.notes.empty();
  });
}

}  // namespace rehearse::check
