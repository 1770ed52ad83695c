#pragma once

#include <string>

#include "rehearse/scenario/drawing.hpp"

namespace rehearse::experiment {

/// The text of a motion file: how a robot moves through states (T+1 × dx). A state that is not finite has nulls.
std::string motion_json(const scenario::Drawing& drawing, const Matrix& states);

}  // namespace rehearse::experiment
