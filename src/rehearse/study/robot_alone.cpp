#include "rehearse/study/robot_alone.hpp"

namespace rehearse::study {

Task robot_alone(Task task) {
  const Index own = task.actuators().own_states();
  task.states.resize(static_cast<std::size_t>(own));
  task.start_mean.conservativeResize(own);
  task.start_std.conservativeResize(own);
  for (ActionVariable& action : task.actions) action.actuation = {};
  task.memory = 0;
  return task;
}

Episode robot_alone(Episode episode, const Actuators& actuators) {
  const Matrix commands = episode.actions;
  actuators.moving(episode.states.topRows(episode.steps()), commands, episode.actions);
  episode.states.conservativeResize(Eigen::NoChange, actuators.own_states());
  episode.true_states.conservativeResize(Eigen::NoChange, actuators.own_states());
  return episode;
}

}  // namespace rehearse::study
