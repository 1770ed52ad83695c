#include "rehearse/experiment/run.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/experiment/failures.hpp"
#include "rehearse/experiment/open_run.hpp"
#include "rehearse/experiment/participants.hpp"
#include "rehearse/experiment/priors.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/experiment/run_folder.hpp"
#include "rehearse/rollout/execute.hpp"

namespace rehearse::experiment {
namespace {

bool is_over(const Spec& spec, const History& history) { return spec.ends_with(history.done(), history.ends_solved()); }

void require_plant(const Resolved& resolved) {
  if (!resolved.scenario.make_plant)
    throw InvalidInput(fmt::format(
        "{} has no plant that could be driven: in a run that began with --trials 0 (in Python trials=0) `ask` and "
        "`tell` go on a trial at a time",
        resolved.spec.scenario));
}

/// Throws InvalidInput, for instance where a program cannot be started.
void require_ready(const Resolved& resolved) {
  if (resolved.scenario.require_oracle && is_among(scenario::kOracle, split_names(resolved.spec.prior)))
    resolved.scenario.require_oracle();
  const bool driven = resolved.spec.trials > 0;
  if (resolved.scenario.require_ready)
    resolved.scenario.require_ready(driven ? scenario::PlantUse::driven : scenario::PlantUse::left_alone);
}

/// The same for a run that has begun, as RunFailed: the robot may be ready later, and the run is as good as before.
void require_ready_again(const Resolved& resolved) {
  try {
    require_ready(resolved);
  } catch (const InvalidInput& error) {
    throw RunFailed(error.what(), true);
  }
}

/// ask → execute → tell, to the end.
class Run {
 public:
  Run(Participants& participants, const RunFolder& folder, History history)
      : parts_(participants), folder_(folder), run_(participants, folder, std::move(history)) {}

  RunResult finish() {
    run_.begin(!complete());
    if (!run_.history().asked) folder_.remove_next();  // what a kill has left
    while (!complete()) {
      run_.conclude(execute(run_.propose()));
      folder_.remove_next();
      require_finished();
    }
    if (parts_.resolved().spec.trials > 0) folder_.mark_done(run_.history().done());
    return result();
  }

 private:
  bool complete() const { return is_over(parts_.resolved().spec, run_.history()); }

  Episode execute(const learners::Proposal& proposal) const {
    const Index trial = run_.history().done() + 1;
    const Rng rng({.seed = static_cast<std::uint64_t>(parts_.resolved().spec.seed),
                   .trial = static_cast<std::uint64_t>(trial),
                   .purpose = Purpose::start_state});
    const auto play = [&] {
      return rollout::execute(parts_.plant(), *proposal.policy, proposal.theta, parts_.task(), rng,
                              [&] { parts_.evaluator().stop_if_asked(); });
    };
    return named_failure(trial, "plant", play, parts_.resolved().scenario.faults != nullptr);
  }

  /// After the trial is kept: its torque may still be on.
  void require_finished() const {
    named_failure(run_.history().done(), "plant", [&] { parts_.plant().require_finished(); });
  }

  RunResult result() const {
    const History& history = run_.history();
    RunResult result{.folder = folder_.path(), .trials = history.done()};
    if (history.done() == 0) return result;
    result.best_return = best_trial(history.trials).total_reward;
    result.warnings = history.trials.back().warnings;
    if (const auto& faults = parts_.resolved().scenario.faults)
      for (const std::string& fault : faults()) result.warnings.push_back(fault);
    for (const TrialRecord& trial : history.trials)
      if (!result.solved_at && trial.solved.value_or(false)) result.solved_at = trial.trial;
    return result;
  }

  Participants& parts_;
  const RunFolder& folder_;
  OpenRun run_;
};

/// A begun run's spec, with another end if given.
Spec extended_spec(Spec spec, const std::filesystem::path& path, std::optional<Until> until, Index done) {
  if (!until) return spec;
  spec.trials = until->trials;
  spec.until_solved = until->solved;
  if (spec.trials < 1)  // a line that says it all: bounds of a new run, and trials that are done, say less
    throw InvalidInput(fmt::format("trials = {}, must be ≥ 1 where Rehearse drives the plant", spec.trials));
  Violations violations;
  violations.add(field_violations([&](FieldVisitor& v) { spec.fields(v); }));
  violations.require(spec.trials >= done,
                     fmt::format("trials = {}, but {} trials of {} are done", spec.trials, done, path.string()));
  violations.throw_if_any();
  return spec;
}

}  // namespace

RunResult start_run(const Catalogue& catalogue, const Spec& spec, const std::filesystem::path& path,
                    const RunOptions& options) {
  Participants participants(resolve(catalogue, spec), options);
  const Resolved& resolved = participants.resolved();
  if (spec.trials > 0) require_plant(resolved);
  require_ready(resolved);
  return with_causes(catalogue, resolved.spec, path, [&] {
    const RunFolder folder = RunFolder::create(path, resolved.spec, resolved.comments, resolved.robot);
    return Run(participants, folder, {}).finish();
  });
}

RunResult resume_run(const Catalogue& built_in, const std::filesystem::path& path, std::optional<Until> until,
                     const RunOptions& options) {
  RunFolder folder = RunFolder::open(path);
  const Catalogue catalogue = with_robot_of_run(built_in, path);
  History history = folder.load();
  const Spec extended = extended_spec(folder.spec(), path, until, history.done());
  if (extended.trials == 0)
    throw InvalidInput(
        fmt::format("{} goes on by `ask` and `tell`, a trial at a time; where there is a [plant], "
                    "--trials N (in Python trials=N) lets Rehearse drive it",
                    path.string()));
  Participants participants(resolve(catalogue, extended), options);
  if (!is_over(extended, history)) {
    require_plant(participants.resolved());
    require_ready_again(participants.resolved());
  }
  return with_causes(catalogue, participants.resolved().spec, path, [&] {
    folder.change_end({extended.trials, extended.until_solved}, participants.resolved().comments);
    if (!is_over(extended, history)) folder.mark_unfinished();  // also where a change of its end was interrupted
    return Run(participants, folder, std::move(history)).finish();
  });
}

}  // namespace rehearse::experiment
