#include "rehearse/check/try_out.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

#include <fmt/format.h>

#include "rehearse/check/differences.hpp"
#include "rehearse/check/input_scales.hpp"
#include "rehearse/check/row_laws.hpp"
#include "rehearse/check/task_answers.hpp"
#include "rehearse/check/whole_turns.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/policy/schedule.hpp"
#include "rehearse/recording/rates.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/statistics/columns.hpp"
#include "rehearse/system/simulated_plant.hpp"

namespace rehearse::check {
namespace {

/// Some episodes of random actions on a plant.
struct Driven {
  std::vector<Episode> episodes;
  Dataset steps;                      // of these, by their true states
  std::optional<std::string> failed;  // when and why: "failed in step 3 of …"
};

struct Sample {
  Index episodes = 0;
  std::uint64_t seed = 0;
};

Driven drive(system::Plant& plant, const Task& task, const Sample& sample, const Evaluator& evaluator) {
  const auto schedule = policy::make_schedule(task);
  Driven driven;
  Index step = 0;
  const auto before_step = [&] { evaluator.stop_if_asked(), ++step; };
  try {
    for (Index e = 1; e <= sample.episodes; ++e, step = 0) {
      const StreamKey key{.seed = sample.seed, .trial = static_cast<std::uint64_t>(e), .purpose = Purpose::start_state};
      const Vector actions = policy::random_schedule(task, policy::RandomActions::uniform, 0, key);
      driven.episodes.push_back(rollout::execute(plant, *schedule, actions, task, Rng(key), before_step));
    }
    plant.require_finished();
  } catch (const std::exception& error) {
    const std::string why = error.what();
    driven.failed = fmt::format("failed in step {} of episode {}: {}", step, driven.episodes.size() + 1,
                                why.empty() ? "it does not say why" : why);
  }
  for (Episode episode : driven.episodes) {
    episode.states = episode.true_states;
    driven.steps.append(episode);
  }
  return driven;
}

/// The first prior as a robot.
std::unique_ptr<system::Plant> played_by_prior(const scenario::Scenario& scenario) {
  const scenario::NamedPrior& prior = scenario.priors.front();
  return system::make_simulated_plant(prior.simulator, prior.parameters.values(),
                                      {scenario.task.start_mean, scenario.task.start_std, {}});
}

/// A line for a plant that did not repeat itself; empty: it did.
std::string other_things(const Task& task, const Dataset& one, const Dataset& other) {
  if (one.size() == other.size() && one.changes == other.changes) return {};
  const Index rows = std::min(one.size(), other.size());
  const std::string by =
      difference(task, apart(one.changes.topRows(rows), other.changes.topRows(rows)), Vector::Zero(task.state_size()));
  return fmt::format(
      "the plant does other things from the same start and the same random numbers ({}): a simulation must repeat "
      "itself; a real robot is left alone by --no-plant (in Python plant=False)",
      by.empty() ? "episodes end at other steps" : by);
}

bool broke(const Episode& episode, const std::string& limit) {
  return std::ranges::find(episode.broken_limits, limit) != episode.broken_limits.end();
}

/// A line for each limit that no policy could keep: the start breaks it, and the first step of every episode.
std::vector<std::string> hopeless_limits(const Task& task, const std::vector<Episode>& episodes) {
  std::vector<std::string> lines;
  if (episodes.empty()) return lines;
  for (const std::string& name : rollout::limits_broken_by(task, resting(task, task.start_mean), 0))
    if (std::ranges::all_of(episodes, [&](const Episode& e) { return e.steps() == 1 && broke(e, name); }))
      lines.push_back(fmt::format(
          "limit {}: the start breaks it, and the first step of every episode: keep says what must hold", name));
  return lines;
}

/// The number with two digits, or less.
double rounded_down(double number) {
  if (number == 0) return 0;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(number))) - 1);
  return unit * std::floor(number / unit);
}

/// A line where most steps earn less than those that a fall, or a failure, leaves; empty: they do not.
std::string why_falls_pay(const Task& task, const Driven& driven) {
  const auto failed = [](const Episode& episode) { return !episode.failure.empty(); };
  const bool may_end = task.ended || !task.limits.empty() || std::ranges::any_of(driven.episodes, failed);
  const Vector& rewards = driven.steps.rewards;
  if (!may_end || rewards.size() == 0) return {};
  double sum = 0, least = task.reward_floor;
  Index below = 0;
  for (const double reward : rewards)
    if (reward < task.reward_floor) sum += reward, least = std::min(least, reward), ++below;
  if (2 * below <= rewards.size()) return {};
  return fmt::format(
      "steps under random actions earn about {:.3g}, and each step that is left after a fall earns reward.floor = "
      "{:g}: falling pays, unless the goal earns more; floor = {:.2g} would be safe",
      sum / static_cast<double>(below), task.reward_floor, rounded_down(least));
}

/// Counts the ends of episodes, and notes those that are no falls.
void count_ends(const Task& task, const std::vector<Episode>& episodes, Tried& tried) {
  for (const Limit& limit : task.limits)
    tried.limits.push_back(std::ranges::count_if(episodes, [&](const Episode& e) { return broke(e, limit.name); }));
  for (const Episode& episode : episodes) {
    tried.ended += episode.ended && episode.broken_limits.empty() && episode.failure.empty();
    if (!episode.failure.empty()) tried.notes.push_back("an episode of random actions ended: " + episode.failure);
  }
}

/// A line where the plant ends episodes that the task would not; empty: it does not.
std::string unknown_ends(const Task& task, const Tried& tried) {
  if (task.ended || tried.ended == 0) return {};
  return fmt::format(
      "the plant itself ended {} of {} episodes, which no simulated episode knows: say when it ends by `ended`, "
      "or by a limit",
      tried.ended, tried.episodes);
}

/// The faults of the task itself, where it starts.
std::vector<std::string> faults_of_start(const Task& task, double reward) {
  std::vector<std::string> lines;
  if (!std::isfinite(reward))
    lines.push_back(fmt::format("the reward of the start is {}, must be a finite number", reward));
  if (task.ended && holds(task.ended, task.start_mean))
    lines.emplace_back("an episode ends where it starts: `ended` holds in the start");
  return lines;
}

double reward_of_start(const Task& task) {
  Vector reward(1);
  const Matrix start = task.start_mean.transpose();
  task.reward(start, Matrix::Zero(1, task.action_size()), start, reward);
  return reward(0);
}

void append(std::vector<std::string>& lines, const std::vector<std::string>& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

}  // namespace

Tried try_out(const scenario::Scenario& scenario, const Evaluator& evaluator, Index episodes, std::uint64_t seed) try {
  const Task& task = scenario.task;
  const Sample sample{episodes, seed};
  Tried tried{.episodes = episodes, .start_reward = reward_of_start(task)};
  append(tried.broken, faults_of_start(task, tried.start_reward));
  Driven driven;
  if (scenario.make_plant) {
    driven = drive(*scenario.make_plant(), task, sample, evaluator);
    if (driven.failed) tried.end = "the plant " + *driven.failed;
  }
  tried.played = driven.episodes.empty() && !scenario.priors.empty();
  if (tried.played) {
    driven = drive(*played_by_prior(scenario), task, sample, evaluator);
    if (driven.failed) tried.broken.push_back("the first prior, which plays the robot, " + *driven.failed);
  } else if (scenario.make_plant && !driven.failed) {  // one that failed, or was stopped, is not to move again
    const std::string line =
        other_things(task, driven.steps, drive(*scenario.make_plant(), task, sample, evaluator).steps);
    if (!line.empty()) tried.broken.push_back(line);
  }
  const Dataset& steps = driven.steps;
  tried.steps = steps.size();
  count_ends(task, driven.episodes, tried);
  if (const std::string line = unknown_ends(task, tried); !line.empty()) tried.notes.push_back(line);
  append(tried.broken, hopeless_limits(task, driven.episodes));
  if (const std::string line = why_falls_pay(task, driven); !line.empty()) tried.notes.push_back(line);
  append(tried.notes, where_turns_count(task, seed));
  if (steps.size() == 0) return tried;
  tried.change = statistics::column_root_mean_squares(steps.changes);
  if (scenario.policy) append(tried.notes, notes_on_scales(task, *scenario.policy, steps.states));
  append(tried.notes, recording::notes_on_rates(task, steps.states, steps.states + steps.changes));
  append(tried.broken, broken_row_laws(task, steps.states, steps.actions, steps.changes));
  if (steps.changes.isZero(0))
    tried.broken.emplace_back("no step changes any state: is a formula infinite where it starts?");
  tried.priors = try_priors(scenario, steps, seed);
  return tried;
} catch (const system::Unavailable& error) {
  throw InvalidInput(error.what());
}

}  // namespace rehearse::check
