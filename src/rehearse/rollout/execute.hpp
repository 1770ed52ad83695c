#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "rehearse/core/random.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/policy/policy.hpp"
#include "rehearse/system/plant.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::rollout {

/// One episode on the plant. Rewards and the end use the noise-free state where the plant knows it. What the plant
/// throws reaches the caller, and a state of another size or that is not finite throws std::runtime_error: a real
/// robot's silence is not a fall. An action that is not finite, or outside of its bounds, never reaches the plant: it
/// ends the episode at the reward floor, as a reward that is not finite does, and Episode::failure says so. A step that
/// breaks a limit ends it in the same way, and is the last: Episode::broken_limits. before_step: called before every
/// step; may throw, to stop. Throws InvalidInput, before the plant is reset, if θ, or the policy's actions, are of
/// another size.
Episode execute(system::Plant& plant, const policy::Policy& policy, const Vector& theta, const Task& task, Rng rng,
                const std::function<void()>& before_step = {});

/// A simulator at φ in the place of the plant.
struct SimulatedRobot {
  std::shared_ptr<const system::Simulator> simulator;
  Vector phi;
  Vector measurement_std = {};  // dx; empty: it is measured without noise
};

/// One episode on it, from the task's start. A step that cannot be simulated ends it like a fall.
Episode execute(const SimulatedRobot& robot, const policy::Policy& policy, const Vector& theta, const Task& task,
                Rng rng, const std::function<void()>& before_step = {});

/// An episode that somebody else ran, by its states and actions: with its rewards, and its end at the first fall, or at
/// the first reward that is not finite. It has as many steps as were run. Without true states the measured ones are
/// taken. Throws InvalidInput where its sizes do not fit the task, or a number is not finite.
Episode judged(Episode episode, const Task& task);

/// Ends an episode before its horizon, by the policy's fault: the rest earns the reward floor.
void fail(Episode& episode, const Task& task, const std::string& why);

/// Names of the limits that step t of an episode breaks, by its true states.
std::vector<std::string> limits_broken_by(const Task& task, const Episode& episode, Index t);

/// The episode from its measurements alone: they become its true states, and rewards follow from them, the reward floor
/// where a reward is not finite. Its early end stays. Throws InvalidInput as `judged` does.
Episode as_measured(Episode episode, const Task& task);

}  // namespace rehearse::rollout
