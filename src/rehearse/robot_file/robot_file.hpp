#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "rehearse/robot_file/functions.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::robot_file {

/// The scenario of a robot that a file describes (docs/own-robot.md), which is read once. Use it for a robot without a
/// line of C++. Options are `measurement_noise`, `substeps`, `evaluations`, those of the policy, and `plant.NAME` for
/// every parameter of the plant. source: the file's name, for messages. Throws InvalidInput with a line for everything
/// that is wrong, "SOURCE: line N: …". functions: those of the program, which the file may name.
scenario::MakeBuilder maker(std::string_view text, const std::string& source, const scenario::ReadFile& read_file,
                            const Functions& functions = {});

/// The same for one builder.
std::unique_ptr<scenario::ScenarioBuilder> builder(std::string_view text, const std::string& source,
                                                   const scenario::ReadFile& read_file,
                                                   const Functions& functions = {});

}  // namespace rehearse::robot_file
