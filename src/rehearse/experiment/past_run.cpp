#include "rehearse/experiment/past_run.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/experiment/kept_robot.hpp"
#include "rehearse/experiment/priors.hpp"
#include "rehearse/experiment/run_folder.hpp"
#include "rehearse/policy/by_name.hpp"

namespace rehearse::experiment {

const TrialRecord& PastRun::trial(std::optional<Index> number) const {
  const Index done = history.done();
  if (history.asked && number == history.asked->trial) return *history.asked;
  const std::string asked =
      history.asked ? fmt::format("; trial {0} is asked for, --trial {0} (in Python trial={0})", history.asked->trial)
                    : "";
  if (done == 0) throw InvalidInput("no trial is done yet" + asked);
  if (!number) return best_trial(history.trials);
  if (*number < 1 || *number > done)
    throw InvalidInput(
        fmt::format("trial = {}, must be between 1 and {}, the trials that are done{}", *number, done, asked));
  return history.trials[static_cast<std::size_t>(*number - 1)];
}

std::vector<std::pair<std::string, std::string>> PastRun::as_identified(
    const std::vector<std::pair<std::string, std::string>>& others) const {
  const prior::Prior* prior = resolved.stand_in();
  if (!prior) return others;
  const std::vector<double> none;
  const std::vector<double>& phi = history.asked            ? history.asked->phi
                                   : history.trials.empty() ? none
                                                            : history.trials.back().phi;
  std::vector<std::pair<std::string, std::string>> settings;
  std::size_t next = 0;
  const auto is_set = [&](const std::string& key) {
    return std::ranges::any_of(others, [&](const auto& each) { return without_prior(each.first, prior->name) == key; });
  };
  for (const Parameter& parameter : prior->space.all()) {
    if (!parameter.tunable() || next == phi.size()) continue;
    const double identified = phi[next++];
    if (const std::string key = "prior." + parameter.name; !is_set(key))
      settings.emplace_back(key, to_text(identified));
  }
  settings.insert(settings.end(), others.begin(), others.end());
  return settings;
}

PastRun read_run(const Catalogue& catalogue, const std::filesystem::path& folder) {
  auto [spec, history] = RunFolder::read(folder);
  Catalogue of_run = with_robot_of_run(catalogue, folder);
  Resolved resolved = resolve_begun(of_run, spec);
  return {std::move(resolved), std::move(history), std::move(of_run)};
}

std::shared_ptr<const policy::Policy> policy_of(const TrialRecord& trial, const scenario::Scenario& scenario) {
  try {
    return policy::by_name(trial.policy, trial.theta.size(), scenario.task, scenario.policy);
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("trial {}: {}", trial.trial, error.what()));
  }
}

}  // namespace rehearse::experiment
