#include "rehearse/experiment/next_files.hpp"

#include <nlohmann/json.hpp>

namespace rehearse::experiment {

void update_next_files(const RunFolder& folder, const Resolved& resolved, const std::optional<TrialRecord>& asked) {
  if (!asked) return folder.remove_next();
  nlohmann::ordered_json policy = {{"format", 1},
                                   {"scenario", resolved.spec.scenario},
                                   {"trial", asked->trial},
                                   {"policy", asked->policy},
                                   {"theta", std::vector<double>(asked->theta.begin(), asked->theta.end())}};
  folder.write_next("policy.json", policy.dump(1) + "\n");
}

}  // namespace rehearse::experiment
