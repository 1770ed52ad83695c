#include "rehearse/experiment/policy_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/failures.hpp"
#include "rehearse/experiment/record.hpp"
#include "rehearse/files/csv.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/statistics/intervals.hpp"

namespace rehearse::experiment {
namespace {

constexpr Index kEpisodesOfAPlant = 10;  // fixed: what a plant remembers from one to the next decides results
constexpr double kLongest = 1e6;         // steps

Outcome outcome_of(const Episode& episode, const Task& task) {
  Outcome outcome{.total_reward = episode.total_reward()};
  if (episode.ended) outcome.ended_s = seconds(episode.steps(), task.dt_s);
  outcome.broke = episode.broken_limits;
  if (!task.solved) return outcome;
  const Index T = task.horizon;
  const bool lasted = episode.steps() >= T && !(episode.ended && episode.steps() == T);
  outcome.solved = task.solved(lasted ? episode.part(0, T) : episode);
  outcome.solved_at_end = !episode.ended && task.solved(episode.part(episode.steps() - T, T));
  return outcome;
}

StreamKey stream_of(const EvaluationPlan& plan, const Learned& learned, Index episode) {
  return {.seed = static_cast<std::uint64_t>(plan.seed),
          .trial = static_cast<std::uint64_t>(learned.trial),
          .stage = Stage::evaluation,
          .search = 1,  // 0 is that of expected_return
          .purpose = Purpose::start_state,
          .candidate = static_cast<std::uint64_t>(episode)};
}

std::optional<statistics::Rate> rate_of(const std::vector<Outcome>& outcomes, std::optional<bool> Outcome::*what) {
  if (std::ranges::any_of(outcomes, [&](const Outcome& each) { return !(each.*what); })) return {};
  return statistics::rate(std::ranges::count_if(outcomes, [&](const Outcome& each) { return *(each.*what); }),
                          static_cast<Index>(outcomes.size()));
}

std::string cell(const std::optional<bool>& flag) { return !flag ? "" : *flag ? "1" : "0"; }

/// The robot of some episodes, one after the other; there must be one. A step that a prior which plays it cannot
/// simulate is a fall, as in the rollouts that the policy was learned in.
class Robot {
 public:
  explicit Robot(const Resolved& resolved) : stand_in_(resolved.stand_in()), noise_(resolved.scenario.stand_in_noise) {
    if (resolved.scenario.make_plant) plant_ = resolved.scenario.make_plant();
  }

  Episode episode(const Learned& learned, const Task& task, const Rng& rng, const std::function<void()>& ask) {
    const policy::Policy& policy = *learned.policy;
    if (plant_) return rollout::execute(*plant_, policy, learned.theta, task, rng, ask);
    return rollout::execute({stand_in_->simulator, stand_in_->space.values(), noise_}, policy, learned.theta, task, rng,
                            ask);
  }

  void require_finished() {
    if (plant_) plant_->require_finished();
  }

 private:
  std::unique_ptr<system::Plant> plant_;
  const prior::Prior* stand_in_;
  const Vector& noise_;
};

}  // namespace

bool has_robot(const Resolved& resolved) { return resolved.scenario.make_plant || resolved.stand_in(); }

Index EvaluationPlan::steps(const Task& task) const {
  const double wanted = seconds == 0 ? static_cast<double>(task.horizon) : std::round(seconds / task.dt_s);
  Violations violations;
  violations.require(wanted >= static_cast<double>(task.horizon) && wanted <= kLongest,
                     fmt::format("seconds = {}, must be between {} (an episode of the task) and {}", seconds,
                                 rehearse::seconds(task.horizon, task.dt_s), kLongest * task.dt_s));
  violations.add(field_violations([plan = *this](FieldVisitor& v) mutable { plan.fields(v); }));
  violations.throw_if_any();
  return static_cast<Index>(wanted);
}

std::string why_no_robot(const Resolved& resolved) {
  return fmt::format(
      "{} has no plant that episodes could run on, and the run has no prior that could play it, or several",
      resolved.scenario.name);
}

std::vector<Outcome> evaluate(const Resolved& resolved, const Learned& learned, const EvaluationPlan& plan,
                              const Evaluator& evaluator) {
  const scenario::Scenario& scenario = resolved.scenario;
  if (!has_robot(resolved)) throw InvalidInput(why_no_robot(resolved));
  Task longer = scenario.task;
  longer.horizon = plan.steps(scenario.task);
  if (learned.theta.size() != learned.policy->parameters())
    throw InvalidInput(fmt::format("theta has {} numbers, must have the {} of the policy", learned.theta.size(),
                                   learned.policy->parameters()));
  std::vector<Outcome> outcomes(static_cast<std::size_t>(plan.episodes));
  const Index parts = (plan.episodes + kEpisodesOfAPlant - 1) / kEpisodesOfAPlant;
  const auto ask = [&] { evaluator.stop_if_asked(); };
  const auto run_part = [&](Index of) {
    Robot robot(resolved);
    const Index first = of * kEpisodesOfAPlant, end = std::min(first + kEpisodesOfAPlant, plan.episodes);
    for (Index i = first; i < end; ++i)
      outcomes[static_cast<std::size_t>(i)] =
          outcome_of(robot.episode(learned, longer, Rng(stream_of(plan, learned, i)), ask), scenario.task);
    robot.require_finished();
  };
  evaluator.for_each(parts,
                     [&](Index of) { named_failure(learned.trial, "plant of the evaluation", [&] { run_part(of); }); });
  return outcomes;
}

Summary summary_of(const std::vector<Outcome>& outcomes) {
  Summary summary{.solved = rate_of(outcomes, &Outcome::solved),
                  .solved_at_end = rate_of(outcomes, &Outcome::solved_at_end)};
  const auto fell = [](const Outcome& each) { return each.ended_s.has_value(); };
  summary.ended = statistics::rate(std::ranges::count_if(outcomes, fell), static_cast<Index>(outcomes.size()));
  std::map<std::string, Index> broke;
  for (const Outcome& each : outcomes) {
    summary.returns.push_back(each.total_reward);
    for (const std::string& limit : each.broke) ++broke[limit];
  }
  for (const auto& [limit, count] : broke)
    summary.broke[limit] = statistics::rate(count, static_cast<Index>(outcomes.size()));
  return summary;
}

std::vector<std::string> about_cells(const EvaluationAbout& about) {
  return {files::Csv::cell(about.trial), about.settings, files::Csv::cell(about.seed), files::Csv::cell(about.seconds)};
}

std::string evaluation_csv(const std::vector<Outcome>& outcomes, const EvaluationAbout& about) {
  std::vector<std::string> header = kAboutColumns;
  header.insert(header.end(), {"episode", "return", "solved", "solved_at_end", "ended_s", "broke"});
  files::Csv csv(header);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    std::vector<std::string> row = about_cells(about);
    row.insert(row.end(),
               {files::Csv::cell(static_cast<Index>(i + 1)), files::Csv::cell(outcomes[i].total_reward),
                cell(outcomes[i].solved), cell(outcomes[i].solved_at_end), files::Csv::cell(outcomes[i].ended_s),
                fmt::format("{}", fmt::join(outcomes[i].broke, "; "))});
    csv.row(row);
  }
  return csv.text();
}

}  // namespace rehearse::experiment
