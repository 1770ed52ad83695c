#pragma once

#include <optional>

#include "rehearse/expression/program.hpp"
#include "rehearse/reward/saturating.hpp"
#include "rehearse/robot_file/robot.hpp"

namespace rehearse::robot_file {

/// The closed form that moment matching needs. Distances have one where each is a sum of multiples of features (states,
/// sines and cosines of angles); a formula where it is exp(…) of a sum of squares of such sums, all of them negative.
/// Empty elsewhere.
std::optional<reward::ClosedForm> closed_form(const Robot& robot);

/// The formula's exponent as a function of states, where the formula is exp(…); empty elsewhere.
std::optional<expression::Program> exponent_of(const Robot& robot, const Formula& formula);

}  // namespace rehearse::robot_file
