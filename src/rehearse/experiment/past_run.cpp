#include "rehearse/experiment/past_run.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/checkpoint.hpp"
#include "rehearse/experiment/kept_robot.hpp"
#include "rehearse/experiment/spec_file.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/policy/schedule.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

constexpr const char *kSpec = "spec.toml", *kCheckpoint = "checkpoint";

void require_run_folder(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InvalidInput(fmt::format("{} is not a folder", folder.string()));
  for (const char* file : {kSpec, kCheckpoint})
    if (!fs::exists(folder / file))
      throw InvalidInput(fmt::format("{} is not a run folder: it has no {}", folder.string(), file));
}

}  // namespace

const TrialRecord& PastRun::trial(std::optional<Index> number) const {
  if (!number) return best_trial(history.trials);
  if (*number < 1 || *number > history.done())
    throw InvalidInput(
        fmt::format("trial = {}, must be between 1 and {}, the trials that are done", *number, history.done()));
  return history.trials[static_cast<std::size_t>(*number - 1)];
}

PastRun read_run(const Catalogue& catalogue, const fs::path& folder,
                 const std::vector<std::pair<std::string, std::string>>& settings) {
  require_run_folder(folder);
  const fs::path file = folder / kSpec;
  Spec spec = from_toml(files::read_file(file), file.string());
  const std::uint64_t kept = fingerprint(spec);
  History history;
  try {
    history = from_checkpoint(files::read_file(folder / kCheckpoint), kept);
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("{}: {}", folder.string(), error.what()));
  }
  if (history.done() == 0) throw InvalidInput(fmt::format("no trial of {} is done yet", folder.string()));
  spec.options.insert(spec.options.end(), settings.begin(), settings.end());
  return {resolve(with_robot_of_run(catalogue, folder), spec), std::move(history)};
}

std::shared_ptr<const policy::Policy> policy_of(const TrialRecord& trial, const scenario::Scenario& scenario) {
  if (trial.policy == scenario.policy->name()) return scenario.policy;
  const Task& task = scenario.task;
  auto schedule = policy::make_schedule(task.action_bounds(), task.dt_s, task.horizon);
  if (trial.policy == schedule->name()) return schedule;
  throw InvalidInput(fmt::format("trial {} has the policy '{}', which is neither the scenario's, '{}', nor '{}'",
                                 trial.trial, trial.policy, scenario.policy->name(), schedule->name()));
}

}  // namespace rehearse::experiment
