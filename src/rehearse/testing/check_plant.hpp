#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "rehearse/core/task.hpp"
#include "rehearse/system/plant.hpp"

namespace rehearse::testing {

/// The laws of a simulated plant, tried on two episodes of random actions. Returns a line for each that is broken:
///
/// - `reset` with the same Rng, and then the same actions, give the same episode to the bit: after another episode, and
///   on another plant of the same type;
/// - measured states have dx finite entries; `truth` has dx of them or none.
std::vector<std::string> check_plant(const std::function<std::unique_ptr<system::Plant>()>& make, const Task& task,
                                     std::uint64_t seed = 1);

}  // namespace rehearse::testing
