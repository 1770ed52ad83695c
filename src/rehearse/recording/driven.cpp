#include "rehearse/recording/driven.hpp"

#include <utility>

#include "rehearse/recording/plausible.hpp"
#include "rehearse/recording/rates.hpp"

namespace rehearse::recording {
namespace {

/// The first `count` variables as the columns of the episode's file.
template <class Variable>
std::vector<Channel> channels_of(const std::vector<Variable>& variables, Index count, const Matrix& values,
                                 double dt_s) {
  std::vector<Channel> channels;
  for (Index i = 0; i < count; ++i) {
    const Variable& variable = variables[static_cast<std::size_t>(i)];
    Channel channel{variable.name, variable.unit, {}};
    for (Index k = 0; k < values.rows(); ++k)
      channel.samples.push_back({static_cast<double>(k) * dt_s, values(k, i), k + 2});
    channels.push_back(std::move(channel));
  }
  return channels;
}

}  // namespace

std::vector<std::string> notes_on_driven(const Task& task, const Episode& episode, const std::string& file) {
  const Matrix& states = episode.states;
  // Without what actuators remember of commands, which may jump.
  const std::vector<Channel> channels = channels_of(task.states, task.actuators().own_states(), states, task.dt_s);
  const std::vector<Channel> pushes = channels_of(task.actions, task.action_size(), episode.actions, task.dt_s);
  const std::vector<const Channel*> rates = rates_of(channels, task);
  Problems jumps(file);
  for (std::size_t s = 0; s < channels.size(); ++s) check_jumps(channels[s], rates[s], pushes, jumps);
  std::vector<std::string> notes = jumps.lines();
  const Index steps = states.rows() - 1;
  for (std::string& note : notes_on_rates(task, states.topRows(steps), states.bottomRows(steps)))
    notes.push_back(std::move(note));
  return notes;
}

}  // namespace rehearse::recording
