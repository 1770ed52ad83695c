#include "rehearse/experiment/policy_match.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/names.hpp"
#include "rehearse/experiment/past_run.hpp"
#include "rehearse/recording/units.hpp"

namespace rehearse::experiment {
namespace {

constexpr double kSameActions = 0.01;  // of the range of an action: motors are not exact
constexpr double kOtherActions = 0.2;  // likewise: beyond, the file may be a wrong one

/// The episode as it would be if something was the matter with its file.
struct Reading {
  std::string cause;
  Episode episode;
};

/// States that are in another unit, each "NAME [UNIT]".
Reading in_units(const Episode& episode, const Task& task, const std::vector<std::pair<Index, std::string>>& units) {
  Reading reading{.cause = {}, .episode = episode};
  std::vector<std::string> titles;
  for (const auto& [s, unit] : units) {
    const StateVariable& state = task.states[static_cast<std::size_t>(s)];
    reading.episode.states.col(s) *= *recording::conversion(unit, state.unit);
    titles.push_back(fmt::format("'{} [{}]'", state.name, unit));
  }
  reading.cause = fmt::format("{} {}", titles.size() > 1 ? "columns are" : "a column is", fmt::join(titles, ", "));
  return reading;
}

/// One state in another unit; a state with its rate, and all that can be, in degrees, centimetres or millimetres.
std::vector<Reading> other_units(const Episode& episode, const Task& task) {
  std::vector<Reading> readings;
  std::map<std::string, std::vector<std::pair<Index, std::string>>> together;  // by how the unit begins
  for (Index s = 0; s < task.actuators().own_states(); ++s) {
    const std::string& unit = task.states[static_cast<std::size_t>(s)].unit;
    for (const std::string& other : recording::units_like(unit)) {
      const auto factor = recording::conversion(other, unit);
      if (!factor || *factor == 1) continue;
      readings.push_back(in_units(episode, task, {{s, other}}));
      together[other.substr(0, other.find('/'))].emplace_back(s, other);
    }
  }
  for (const auto& [unit, states] : together) {
    if (states.size() > 1) readings.push_back(in_units(episode, task, states));
    for (const Kinematics::Pair& pair : task.kinematics().pairs) {
      std::vector<std::pair<Index, std::string>> both;
      for (const auto& state : states)
        if (state.first == pair.position || state.first == pair.rate) both.push_back(state);
      if (both.size() == 2 && states.size() > 2) readings.push_back(in_units(episode, task, both));
    }
  }
  return readings;
}

std::vector<Reading> other_signs(const Episode& episode, const Task& task) {
  std::vector<Reading> readings;
  const auto add = [&](const std::string& name, Matrix Episode::*numbers, Index column) {
    readings.push_back({fmt::format("{} has the other sign", name), episode});
    (readings.back().episode.*numbers).col(column) *= -1;
  };
  for (Index s = 0; s < task.actuators().own_states(); ++s)
    add(task.states[static_cast<std::size_t>(s)].name, &Episode::states, s);
  for (Index a = 0; a < task.action_size(); ++a)
    add(task.actions[static_cast<std::size_t>(a)].name, &Episode::actions, a);
  return readings;
}

/// Two states stand in each other's column.
std::vector<Reading> exchanged(const Episode& episode, const Task& task) {
  std::vector<Reading> readings;
  for (Index s = 0, own = task.actuators().own_states(); s < own; ++s)
    for (Index other = s + 1; other < own; ++other) {
      const auto name = [&](Index i) { return task.states[static_cast<std::size_t>(i)].name; };
      readings.push_back({fmt::format("{} and {} are exchanged", name(s), name(other)), episode});
      readings.back().episode.states.col(s).swap(readings.back().episode.states.col(other));
    }
  return readings;
}

/// The policy begins some steps later, behind rows of a logger that was on before.
std::vector<Reading> later_beginnings(const Episode& episode, const Task& task) {
  constexpr Index kMost = 200;  // each costs an episode of actions
  std::vector<Reading> readings;
  const Index steps = episode.steps(), stride = std::max<Index>(1, steps / (2 * kMost));
  for (Index before = stride; 2 * before <= steps; before += stride)
    readings.push_back({fmt::format("it begins at {:.3g} s: the rows before are to be left out",
                                    static_cast<double>(before) * task.dt_s),
                        episode.part(before, steps - before)});
  return readings;
}

/// The action of each row stands one row later.
Reading a_row_late(const Episode& episode) {
  const Index steps = episode.steps() - 1;
  Episode moved = episode.part(0, steps);
  moved.actions = episode.actions.bottomRows(steps);
  return {"each row has the action of the row before", std::move(moved)};
}

double part_of_range(double deviation, const ActionVariable& action) {
  return deviation / (action.bounds.high - action.bounds.low);
}

/// The largest deviation, as a part of its action's range.
double largest_part(const Vector& deviations, const Task& task) {
  double most = 0;
  for (Index i = 0; i < deviations.size(); ++i)
    most = std::max(most, part_of_range(deviations(i), task.actions[static_cast<std::size_t>(i)]));
  return most;
}

/// The cause that explains the actions best; empty: none that is tried does.
std::string cause_of(const ReadEpisode& read, const scenario::Scenario& scenario, const TrialRecord& asked,
                     const std::vector<TrialRecord>& earlier) {
  const auto& [episode, off] = read;
  const Task& task = scenario.task;
  std::string cause;
  double left = kSameActions;
  const auto consider = [&, off = off](const Episode& other, const TrialRecord& trial, const std::string& said) {
    const double deviation = largest_deviation({other, off}, scenario, trial);
    if (deviation < left) left = deviation, cause = said;
  };
  for (const TrialRecord& trial : earlier)
    consider(episode, trial, fmt::format("they are those of the policy of trial {}", trial.trial));
  std::vector<Reading> readings = other_units(episode, task);
  for (const auto& of : {other_signs, exchanged, later_beginnings})
    for (Reading& reading : of(episode, task)) readings.push_back(std::move(reading));
  if (episode.steps() > 1) readings.push_back(a_row_late(episode));
  for (const Reading& reading : readings)
    consider(reading.episode, asked, fmt::format("they are the policy's if {}", reading.cause));
  return cause;
}

/// The policy's actions in the measured states (steps × du).
Matrix actions_in(const Episode& episode, const scenario::Scenario& scenario, const TrialRecord& trial) {
  const Task& task = scenario.task;
  const auto policy = policy_of(trial, scenario);
  const Actuators actuators = task.actuators();
  Matrix all(episode.steps(), task.action_size()), u(1, task.action_size());
  for (Index t = 0; t < episode.steps(); ++t) {
    policy->act(trial.theta.transpose(), episode.states.middleRows(t, 1), static_cast<double>(t) * task.dt_s, u);
    actuators.command(episode.states.middleRows(t, 1), u);
    all.row(t) = u;
  }
  return all;
}

}  // namespace

Vector deviations(const ReadEpisode& read, const scenario::Scenario& scenario, const TrialRecord& trial) {
  const Index steps = read.episode.steps();
  const Matrix of_policy = actions_in(read.episode, scenario, trial);
  Matrix low = of_policy, high = of_policy;
  for (Index t = 0; t < steps; ++t)
    for (const Index beside : {std::max<Index>(t - 1, 0), std::min(t + 1, steps - 1)}) {
      const auto between = (1 - read.off) * of_policy.row(t) + read.off * of_policy.row(beside);
      low.row(t) = low.row(t).cwiseMin(between);
      high.row(t) = high.row(t).cwiseMax(between);
    }
  const Matrix beyond = (low - read.episode.actions).cwiseMax(read.episode.actions - high).cwiseMax(0.0);
  return (beyond.cwiseAbs2().colwise().sum().transpose() / static_cast<double>(steps)).cwiseSqrt();
}

double largest_deviation(const ReadEpisode& read, const scenario::Scenario& scenario, const TrialRecord& trial) {
  if (read.episode.steps() == 0) return kInf;
  return largest_part(deviations(read, scenario, trial), scenario.task);
}

bool has_actions_of(const ReadEpisode& read, const scenario::Scenario& scenario, const TrialRecord& trial) {
  return largest_deviation(read, scenario, trial) <= kSameActions;
}

std::vector<std::string> sentences_on_policy(const ReadEpisode& read, const scenario::Scenario& scenario,
                                             const TrialRecord& asked, const std::vector<TrialRecord>& earlier) {
  const Vector all = deviations(read, scenario, asked);
  if (largest_part(all, scenario.task) <= kSameActions) return {};
  const std::string cause = cause_of(read, scenario, asked, earlier);
  std::vector<std::string> sentences;
  for (Index i = 0; i < all.size(); ++i) {
    const ActionVariable& action = scenario.task.actions[static_cast<std::size_t>(i)];
    const double part = part_of_range(all(i), action);
    if (part <= kSameActions) continue;
    const bool wrong_file = !cause.empty() || part > kOtherActions;
    sentences.push_back(
        fmt::format("{} differs from what the policy says of the measured states by {:.3g}{} (root mean square): {}{}",
                    action.name, all(i), unit_text(action.unit),
                    cause.empty() ? "another policy, a state of another unit or sign, a delay, or a weak motor" : cause,
                    wrong_file ? "; `tell --undo` (in Python `take_back()`) takes a wrong file back" : ""));
  }
  return sentences;
}

}  // namespace rehearse::experiment
