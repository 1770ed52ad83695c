#include "rehearse/experiment/next_files.hpp"

#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/exported_policy.hpp"

namespace rehearse::experiment {
namespace {

/// A policy of one's own, which nobody can describe, is known by its name and θ.
std::string name_and_theta(const TrialRecord& asked) {
  const nlohmann::ordered_json policy = {{"format", 1},
                                         {"trial", asked.trial},
                                         {"policy", asked.policy},
                                         {"theta", std::vector<double>(asked.theta.begin(), asked.theta.end())}};
  return policy.dump(1) + "\n";
}

}  // namespace

void update_next_files(const RunFolder& folder, const Resolved& resolved, const History& history) {
  if (!history.asked) return folder.remove_next();
  try {
    const policy::Exported exported = exported_policy(resolved, *history.asked, an_episode(history));
    folder.write_next("policy.h", policy::to_c(exported, "policy"));
    folder.write_next("policy.json", policy::to_json(exported));
    folder.write_next("policy.py", policy::to_numpy(exported));
  } catch (const InvalidInput&) {
    folder.write_next("policy.json", name_and_theta(*history.asked));
  }
}

}  // namespace rehearse::experiment
