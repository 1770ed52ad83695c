#include "rehearse/robot_file/complaints.hpp"

#include <fmt/format.h>

namespace rehearse::robot_file {

std::vector<std::string> complaints(const Tried& tried) {
  std::vector<std::string> lines = tried.broken;
  if (tried.end)
    lines.push_back(fmt::format("the plant failed after {} steps: {}", tried.steps,
                                tried.end->empty() ? "it does not say why" : *tried.end));
  for (const PriorTried& prior : tried.priors) {
    const bool fails = tried.steps > 0 && prior.failed == tried.steps;
    for (const std::string& name : fails ? std::vector<std::string>() : prior.idle)
      lines.push_back(fmt::format(
          "prior {}: {} changes no prediction on the {} states tried, so it cannot be learned; is its name right "
          "where it is used? If it acts farther off alone, let [[state]] start or start_noise lead there; `learn` "
          "takes it all the same",
          prior.name, name, prior.states));
    if (!prior.broken.empty()) lines.push_back(fmt::format("prior {}: {}", prior.name, prior.broken));
    if (prior.failed > 0)
      lines.push_back(fmt::format("prior {}: {} of {} rows have no prediction{}", prior.name, prior.failed, tried.steps,
                                  fails ? "; is dt_s in seconds?" : ""));
  }
  return lines;
}

}  // namespace rehearse::robot_file
