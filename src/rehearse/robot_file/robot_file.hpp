#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "rehearse/scenario/scenario.hpp"

namespace rehearse::robot_file {

/// The bytes of a file by its path from the robot's file; empty: there is none.
using ReadFile = std::function<std::optional<std::string>(const std::string& path)>;

/// The scenario of a robot that a file describes (docs/own-robot.md). Use it for a robot without a line of C++. Options
/// are `measurement_noise`, `substeps`, `evaluations`, those of the policy, and `plant.NAME` for every parameter of the
/// plant. source: the file's name, for messages. Throws InvalidInput with a line for everything that is wrong,
/// "SOURCE: line N: …".
std::unique_ptr<scenario::ScenarioBuilder> builder(std::string_view text, const std::string& source,
                                                   const ReadFile& read_file);

}  // namespace rehearse::robot_file
