#include "rehearse/experiment/open_run.hpp"

#include <fmt/format.h>

#include "rehearse/experiment/expected_return.hpp"
#include "rehearse/experiment/failures.hpp"
#include "rehearse/experiment/forecast.hpp"
#include "rehearse/experiment/motion.hpp"
#include "rehearse/experiment/tables.hpp"
#include "rehearse/experiment/trial_record.hpp"
#include "rehearse/recording/driven.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/rollout/simulate.hpp"
#include "rehearse/statistics/columns.hpp"

namespace rehearse::experiment {
namespace {

constexpr Index kPredictionParticles = 100;

/// Mean states by step (T+1 × dx), of the particles that are still finite.
Matrix mean_states(const rollout::Recorded& recorded) {
  Matrix means(recorded.states.size(), recorded.states.front().cols());
  for (std::size_t t = 0; t < recorded.states.size(); ++t)
    means.row(static_cast<Index>(t)) = statistics::column_means(recorded.states[t]);
  return means;
}

const learners::Proposal& checked(const learners::Proposal& proposal) {
  if (!proposal.policy) throw std::runtime_error("it proposed no policy");
  const Index size = proposal.theta.size(), wanted = proposal.policy->parameters();
  if (size != wanted || !proposal.theta.allFinite())
    throw std::runtime_error(fmt::format("it proposed {} parameters, the policy has {} finite ones", size, wanted));
  return proposal;
}

}  // namespace

void OpenRun::begin(bool something_to_come) {
  parts_.open_store(path());
  folder_.forget_failure();
  if (parts_.options().listener) parts_.options().listener->started(parts_.resolved(), path(), history_.done());
  publish_logs();
  publish();
  if (history_.told < history_.done() && !history_.trials.back().file_checksum.empty()) announce();
  if (history_.done() > 0) evaluate_last();
  if (something_to_come || history_.told < history_.done()) catch_up();
}

/// Brings a new learner to the last trial that was told.
void OpenRun::load_learner() {
  std::vector<Episode> told;
  parts_.learner().study(as_told(history_.logs));
  for (Index i = 0; i < history_.told; ++i) told.push_back(as_told(history_.episodes[static_cast<std::size_t>(i)]));
  if (history_.told > 0)
    named_failure(history_.told, "learner", [&] { parts_.learner().load(told, history_.learner); });
}

/// Brings a new learner to where the history ends.
void OpenRun::catch_up() {
  load_learner();
  if (history_.told < history_.done()) tell_last();
}

/// known: the record of the trial, where one was kept.
const learners::Proposal& OpenRun::ask(Index trial, const TrialRecord* known) {
  parts_.begin_trial(trial);
  parts_.evaluator().stop_if_asked();
  const auto& proposal = named_failure(trial, "learner", [&]() -> const learners::Proposal& {
    return checked(known ? parts_.learner().ask_again({known->policy, known->theta}) : parts_.learner().ask());
  });
  const auto is_known = [&] {  // Eigen compares vectors of equal sizes
    return proposal.policy->name() == known->policy && proposal.theta.size() == known->theta.size() &&
           proposal.theta == known->theta;
  };
  if (known && !is_known()) throw RunFailed(fmt::format("trial {}: the learner no longer proposes what it did", trial));
  parts_.evaluator().stop_if_asked();
  return proposal;
}

Episode OpenRun::as_told(const Episode& episode) const {
  const bool measured = parts_.resolved().spec.told_by == ToldBy::measured;
  return measured ? rollout::as_measured(episode, parts_.task()) : episode;
}

/// Tells the learner the last trial. Its proposal may have to be computed again first: learners learn from it, too.
void OpenRun::tell_last() {
  TrialRecord& last = history_.trials.back();
  const learners::Proposal& proposal = proposal_ ? *proposal_ : ask(last.trial, &last);
  proposal_ = nullptr;
  if (proposal.model)
    last.forecast = named_failure(last.trial, "model of the learner", [&] {
      return forecast_errors(*proposal.model, parts_.task(), history_.episodes.back(), parts_.evaluator());
    });
  named_failure(last.trial, "learner", [&] {
    parts_.learner().tell(as_told(history_.episodes.back()));
    history_.learner = parts_.learner().save();
  });
  ++history_.told;
  for (const learners::Table& table : parts_.learner().tables()) folder_.write_learners_table(table);
  folder_.write_tables(history_, parts_.resolved());
  folder_.write_checkpoint(history_);  // which says that the tables are there
}

/// Tells who listens that a trial is kept, before what may take long.
void OpenRun::announce() const {
  if (parts_.options().listener) parts_.options().listener->trial_done(history_.trials.back());
}

void OpenRun::update_learners_tables(bool keep) {
  if (history_.told == 0) return;
  parts_.open_store(path());
  load_learner();
  for (const learners::Table& table : parts_.learner().tables())
    keep ? folder_.write_learners_table(table) : folder_.remove_learners_table(table);
}

std::vector<Episode> OpenRun::as_told(const std::vector<Log>& logs) const {
  std::vector<Episode> told;
  told.reserve(logs.size());
  for (const Log& log : logs) told.push_back(as_told(log.episode));
  return told;
}

void OpenRun::change_asked(std::optional<TrialRecord> asked) {
  history_.asked = std::move(asked);
  folder_.write_checkpoint(history_);
}

void OpenRun::add_logs(std::vector<Log> logs) {
  parts_.learner().study(as_told(logs));  // which may refuse them
  for (Log& log : logs) history_.logs.push_back(std::move(log));
  folder_.write_checkpoint(history_);
  folder_.remove_after(history_);  // what a policy predicted that was asked for before
  publish_logs();
  publish();
}

const learners::Proposal& OpenRun::propose() {
  if (proposal_) return *proposal_;
  const Index trial = history_.done() + 1;
  const learners::Proposal& proposal = ask(trial, history_.asked ? &*history_.asked : nullptr);
  proposal_ = &proposal;
  if (history_.asked) return proposal;
  if (proposal.rollouts > 0 && proposal.failed_rollouts == proposal.rollouts)
    throw RunFailed(
        fmt::format("trial {}: every rollout failed, {} of them: {}. No policy was simulated that could move the robot",
                    trial, proposal.rollouts, why_rollouts_failed(proposal)));
  if (proposal.model) predict(trial, proposal);
  if (proposal.archive) folder_.write_archive(*proposal.archive);
  history_.asked = record_before(trial, proposal, parts_.resolved());
  note_lost_rows(*history_.asked);
  folder_.write_checkpoint(history_);
  return proposal;
}

void OpenRun::note_lost_rows(TrialRecord& record) {
  const auto& lost_rows = parts_.resolved().scenario.lost_rows;
  const Index all = lost_rows ? lost_rows() : 0, lost = all - lost_rows_;
  lost_rows_ = all;
  if (lost > 0)
    record.notes.push_back(
        fmt::format("nondeterministic: a program hung or died at {} simulated rows, twice each, which count as failed; "
                    "another time it may answer them",
                    lost));
}

void OpenRun::predict(Index trial, const learners::Proposal& proposal) const {
  const StreamKey key{.seed = static_cast<std::uint64_t>(parts_.resolved().spec.seed),
                      .trial = static_cast<std::uint64_t>(trial),
                      .stage = Stage::prediction};
  const rollout::SimulateOptions unclipped{.noise_clip = 0};
  const auto recorded = rollout::simulate_recorded({*proposal.model, *proposal.policy, parts_.task(), key, unclipped},
                                                   proposal.theta, kPredictionParticles, parts_.evaluator());
  std::optional<ExpectedEpisode> moments;
  if (proposal.moments) moments = proposal.moments();
  folder_.write_prediction(trial, prediction_csv(parts_.task(), recorded, moments ? &*moments : nullptr));
  draw("prediction", trial, mean_states(recorded));
}

void OpenRun::draw(const char* kind, Index trial, const Matrix& states) const {
  const auto& drawing = parts_.resolved().scenario.drawing;
  if (drawing) folder_.write_motion(kind, trial, motion_json(*drawing, states));
}

double OpenRun::interaction_s(const Episode& last) const {
  Index steps = last.steps();
  for (const Episode& before : history_.episodes) steps += before.steps();
  return seconds(steps, parts_.task().dt_s);
}

void OpenRun::record(const Episode& episode, const std::string& file_checksum, const std::vector<std::string>& notes) {
  TrialRecord record = *history_.asked;
  record.file_checksum = file_checksum;
  add_outcome(record, episode, parts_.task());
  record.notes.insert(record.notes.end(), notes.begin(), notes.end());
  record.interaction_s = interaction_s(episode);
  history_.trials.push_back(std::move(record));
  history_.episodes.push_back(episode);
  history_.asked.reset();
  folder_.write_checkpoint(history_);
}

void OpenRun::conclude(const Episode& episode) {
  const std::string file = RunFolder::trajectory_of(history_.done() + 1).string();
  record(episode, "", recording::notes_on_driven(parts_.task(), episode, file));
  publish();
  announce();
  evaluate_last();
  tell_last();
}

/// The logs as they were read, which only a `tell` changes.
void OpenRun::publish_logs() const {
  for (std::size_t i = 0; i < history_.logs.size(); ++i)
    folder_.write_log(static_cast<Index>(i) + 1, trajectory_csv(parts_.task(), history_.logs[i].episode));
}

/// The tables that follow from the history, and the last trial's episode.
void OpenRun::publish() const {
  folder_.write_tables(history_, parts_.resolved());
  if (history_.done() == 0) return;
  const Episode& last = history_.episodes.back();
  folder_.write_trajectory(history_.done(), trajectory_csv(parts_.task(), last));
  draw("trial", history_.done(), last.true_states);
}

/// Unless that was done before a kill.
void OpenRun::evaluate_last() {
  TrialRecord& last = history_.trials.back();
  if (last.expected_return) return;
  last.expected_return = named_failure(last.trial, "plant of the evaluations",
                                       [&] { return expected_return(parts_.resolved(), last, parts_.evaluator()); });
  if (!last.expected_return) return;
  folder_.write_checkpoint(history_);
  folder_.write_tables(history_, parts_.resolved());
}

}  // namespace rehearse::experiment
