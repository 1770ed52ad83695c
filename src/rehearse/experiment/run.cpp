#include "rehearse/experiment/run.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/checkpoint.hpp"
#include "rehearse/experiment/evaluation.hpp"
#include "rehearse/experiment/failures.hpp"
#include "rehearse/experiment/forecast.hpp"
#include "rehearse/experiment/motion.hpp"
#include "rehearse/experiment/participants.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/experiment/run_folder.hpp"
#include "rehearse/experiment/spec_file.hpp"
#include "rehearse/experiment/tables.hpp"
#include "rehearse/experiment/trial_record.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/rollout/simulate.hpp"

namespace rehearse::experiment {
namespace {

constexpr Index kPredictionParticles = 100;

/// By step (T+1 × dx), of the particles that are still finite.
Matrix mean_states(const rollout::Recorded& recorded) {
  Matrix means(recorded.states.size(), recorded.states.front().cols());
  for (std::size_t t = 0; t < recorded.states.size(); ++t)
    means.row(static_cast<Index>(t)) = mean_of_finite(recorded.states[t]);
  return means;
}

/// ask → execute → tell, and the folder.
class Run {
 public:
  Run(Participants& participants, const RunFolder& folder, History history)
      : with_(participants), folder_(folder), history_(std::move(history)) {}

  RunResult finish() {
    with_.open_store(path());
    if (with_.options().listener) with_.options().listener->started(with_.resolved(), path(), history_.done());
    publish();
    if (history_.done() > 0) evaluate_last();
    if (!complete() || history_.told < history_.done()) catch_up();
    while (!complete()) one_trial(history_.done() + 1);
    folder_.mark_done(history_.done());
    return result();
  }

 private:
  bool complete() const {
    const bool solved = history_.done() > 0 && history_.trials.back().solved.value_or(false);
    return with_.resolved().spec.ends_with(history_.done(), solved);
  }

  const std::filesystem::path& path() const { return folder_.path(); }

  /// Brings a new learner to where the history ends.
  void catch_up() {
    std::vector<Episode> told;
    for (Index i = 0; i < history_.told; ++i) told.push_back(as_told(history_.episodes[static_cast<std::size_t>(i)]));
    if (history_.told > 0)
      named_failure(history_.told, "learner", [&] { with_.learner().load(told, history_.learner); });
    if (history_.told == history_.done()) return;
    if (ask(history_.done()).theta != history_.trials.back().theta)  // it may learn from what it proposed, too
      throw RunFailed(fmt::format("trial {}: the learner no longer proposes what it did", history_.done()));
    tell_last();
  }

  const learners::Proposal& ask(Index trial) {
    with_.begin_trial(trial);
    with_.evaluator().stop_if_asked();
    const auto& proposal =
        named_failure(trial, "learner", [&]() -> const learners::Proposal& { return checked(with_.learner().ask()); });
    with_.evaluator().stop_if_asked();
    return proposal;
  }

  Episode as_told(const Episode& episode) const {
    const bool measured = with_.resolved().spec.told_by == ToldBy::measured;
    return measured ? rollout::as_measured(episode, with_.task()) : episode;
  }

  void tell_last() {
    named_failure(history_.done(), "learner", [&] {
      with_.learner().tell(as_told(history_.episodes.back()));
      history_.learner = with_.learner().save();
    });
    ++history_.told;
    for (const learners::Table& table : with_.learner().tables()) folder_.write_learners_table(table);
    folder_.write_checkpoint(history_);  // which says that the tables are there
  }

  void one_trial(Index trial) {
    const learners::Proposal& proposal = ask(trial);
    if (proposal.model) predict(trial, proposal);
    if (proposal.archive) folder_.write_archive(*proposal.archive);
    const Episode episode = named_failure(trial, "plant", [&] { return execute(trial, proposal); });
    keep(record(trial, proposal, episode), episode);
  }

  Episode execute(Index trial, const learners::Proposal& proposal) const {
    const Rng rng({.seed = seed(), .trial = number(trial), .purpose = Purpose::start_state});
    return rollout::execute(with_.plant(), *proposal.policy, proposal.theta, with_.task(), rng,
                            [&] { with_.evaluator().stop_if_asked(); });
  }

  static const learners::Proposal& checked(const learners::Proposal& proposal) {
    if (!proposal.policy) throw std::runtime_error("it proposed no policy");
    const Index size = proposal.theta.size(), wanted = proposal.policy->parameters();
    if (size != wanted || !proposal.theta.allFinite())
      throw std::runtime_error(fmt::format("it proposed {} parameters, the policy has {} finite ones", size, wanted));
    return proposal;
  }

  void predict(Index trial, const learners::Proposal& proposal) const {
    const StreamKey key{.seed = seed(), .trial = number(trial), .stage = Stage::prediction};
    const rollout::SimulateOptions unclipped{.noise_clip = 0};
    const auto recorded = rollout::simulate_recorded({*proposal.model, *proposal.policy, with_.task(), key, unclipped},
                                                     proposal.theta, kPredictionParticles);
    std::optional<ExpectedEpisode> moments;
    if (proposal.moments) moments = proposal.moments();
    folder_.write_prediction(trial, prediction_csv(with_.task(), recorded, moments ? &*moments : nullptr));
    draw("prediction", trial, mean_states(recorded));
  }

  void draw(const char* kind, Index trial, const Matrix& states) const {
    const auto& drawing = with_.resolved().scenario.drawing;
    if (drawing) folder_.write_motion(kind, trial, motion_json(*drawing, states));
  }

  TrialRecord record(Index trial, const learners::Proposal& proposal, const Episode& episode) const {
    TrialRecord record = record_of(trial, proposal, episode, with_.resolved());
    Index steps = episode.steps();
    for (const Episode& before : history_.episodes) steps += before.steps();
    record.interaction_s = seconds(steps, with_.task().dt_s);
    return record;
  }

  /// The episode is on the disk before anything that may take long or fail: a robot does not repeat it.
  void keep(TrialRecord record, const Episode& episode) {
    history_.trials.push_back(std::move(record));
    history_.episodes.push_back(episode);
    folder_.write_checkpoint(history_);
    publish();
    evaluate_last();
    tell_last();
    if (with_.options().listener) with_.options().listener->trial_done(history_.trials.back());
  }

  /// What follows from the history: the tables, and the last trial's episode.
  void publish() const {
    folder_.write_tables(history_, with_.resolved());
    if (history_.done() == 0) return;
    const Episode& last = history_.episodes.back();
    folder_.write_trajectory(history_.done(), trajectory_csv(with_.task(), last));
    draw("trial", history_.done(), last.true_states);
  }

  /// Unless that was done before a kill.
  void evaluate_last() {
    TrialRecord& last = history_.trials.back();
    if (last.expected_return) return;
    last.expected_return = named_failure(last.trial, "plant of the evaluations",
                                         [&] { return expected_return(with_.resolved(), last, with_.evaluator()); });
    if (!last.expected_return) return;
    folder_.write_checkpoint(history_);
    folder_.write_tables(history_, with_.resolved());
  }

  RunResult result() const {
    RunResult result{.folder = path(), .trials = history_.done()};
    result.best_return = best_trial(history_.trials).total_reward;
    result.warnings = history_.trials.back().warnings;
    if (const auto& faults = with_.resolved().scenario.faults)
      for (const std::string& fault : faults()) result.warnings.push_back(fault);
    for (const TrialRecord& trial : history_.trials)
      if (!result.solved_at && trial.solved.value_or(false)) result.solved_at = trial.trial;
    return result;
  }

  std::uint64_t seed() const { return number(with_.resolved().spec.seed); }
  static std::uint64_t number(Index index) { return static_cast<std::uint64_t>(index); }

  Participants& with_;
  const RunFolder& folder_;
  History history_;
};

/// A begun run's spec, with another end if given.
Spec extended_spec(Spec spec, const std::filesystem::path& path, std::optional<Until> until, Index done) {
  if (!until) return spec;
  spec.trials = until->trials;
  spec.until_solved = until->solved;
  Violations violations;
  for (const auto& line : field_violations([&](FieldVisitor& v) { spec.fields(v); })) violations.add(line);
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
  if (resolved.scenario.require_ready) resolved.scenario.require_ready();
  const RunFolder folder = RunFolder::create(path, resolved.spec, resolved.comments, resolved.robot);
  return with_causes(catalogue, resolved.spec, [&] { return Run(participants, folder, {}).finish(); });
}

RunResult resume_run(const Catalogue& built_in, const std::filesystem::path& path, std::optional<Until> until,
                     const RunOptions& options) {
  RunFolder folder = RunFolder::open(path);
  const Catalogue catalogue = with_robot_of_run(built_in, path);
  History history = folder.load();
  const Spec extended = extended_spec(folder.spec(), path, until, history.done());
  Participants participants(resolve(catalogue, extended), options);
  folder.change_end({extended.trials, extended.until_solved}, participants.resolved().comments);
  return with_causes(catalogue, participants.resolved().spec,
                     [&] { return Run(participants, folder, std::move(history)).finish(); });
}

}  // namespace rehearse::experiment
