#include "rehearse/recording/driven.hpp"

#include <utility>

#include "rehearse/recording/plausible.hpp"
#include "rehearse/recording/rates.hpp"

namespace rehearse::recording {
namespace {

/// The robot's own states as the columns of the episode's file, without what actuators remember of commands, which
/// may jump.
std::vector<Channel> channels_of(const Task& task, const Matrix& states) {
  std::vector<Channel> channels;
  for (Index s = 0; s < task.actuators().own_states(); ++s) {
    const StateVariable& state = task.states[static_cast<std::size_t>(s)];
    Channel channel{state.name, state.unit, {}};
    for (Index k = 0; k < states.rows(); ++k)
      channel.samples.push_back({static_cast<double>(k) * task.dt_s, states(k, s), k + 2});
    channels.push_back(std::move(channel));
  }
  return channels;
}

}  // namespace

std::vector<std::string> notes_on_driven(const Task& task, const Matrix& states, const std::string& file) {
  const std::vector<Channel> channels = channels_of(task, states);
  const std::vector<const Channel*> rates = rates_of(channels, task);
  Problems jumps(file);
  for (std::size_t s = 0; s < channels.size(); ++s) check_jumps(channels[s], rates[s], jumps);
  std::vector<std::string> notes = jumps.lines();
  const Index steps = states.rows() - 1;
  for (std::string& note : notes_on_rates(task, states.topRows(steps), states.bottomRows(steps)))
    notes.push_back(std::move(note));
  return notes;
}

}  // namespace rehearse::recording
