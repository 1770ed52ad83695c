#include "rehearse/experiment/second_look.hpp"

#include <algorithm>
#include <chrono>
#include <exception>

#include "rehearse/core/events.hpp"
#include "rehearse/experiment/participants.hpp"
#include "rehearse/experiment/past_run.hpp"
#include "rehearse/study/hints.hpp"
#include "rehearse/study/robot_alone.hpp"

namespace rehearse::experiment {
namespace {

constexpr Index kMany = 3;  // trials after which something may be wrong with file, model or search
constexpr auto kLongestLook = std::chrono::seconds(10);

bool is_unsolved(const PastRun& run) {
  const auto solved = [](const TrialRecord& trial) { return trial.solved.value_or(false); };
  return run.resolved.scenario.task.solved && run.history.done() >= kMany &&
         std::ranges::none_of(run.history.trials, solved);
}

std::vector<study::Hint> hints_of(const PastRun& run, const RunOptions& options) try {
  if (!run.resolved.prior || !run.resolved.prior->space.has_tunable()) return {};
  const auto end = std::chrono::steady_clock::now() + kLongestLook;
  const auto in_time = make_stoppable(evaluator_of(options), [&] { return std::chrono::steady_clock::now() > end; });
  const Task& task = run.resolved.scenario.task;
  const Actuators actuators = task.actuators();
  std::vector<Episode> episodes;
  for (const Episode& episode : run.history.episodes) episodes.push_back(study::robot_alone(episode, actuators));
  return study::find_hints(episodes, study::robot_alone(task), run.resolved.prior->behind_actuators(), {}, *in_time);
} catch (const Interrupted&) {
  return {};
} catch (const std::exception&) {  // what the prior throws is no fault of the trials, which are done
  return {};
}

}  // namespace

SecondLook second_look(const Catalogue& catalogue, const std::filesystem::path& folder, const RunOptions& options) {
  const PastRun run = read_run(catalogue, folder);
  if (!is_unsolved(run)) return {};
  SecondLook look{.readings = {}, .read_on = "what to look at where trials do not get better: docs/does-not-learn.md"};
  for (const study::Hint& hint : hints_of(run, options))
    look.readings.push_back(study::line_of(hint, run.resolved.scenario.task));
  return look;
}

}  // namespace rehearse::experiment
