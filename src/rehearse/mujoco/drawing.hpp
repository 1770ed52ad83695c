#pragma once

#include "rehearse/mujoco/description.hpp"
#include "rehearse/scenario/drawing.hpp"

namespace rehearse::mujoco {

/// The drawing of a model, its parameters at their starts: the geoms that MuJoCo shows at first (groups 0 to 2, not
/// transparent), poses by its kinematics. A cylinder is drawn as a capsule, or as a box where it is flat; an ellipsoid
/// and a mesh as the box around it; height fields are left out. The highest plane that is level is the floor. States
/// that are read only move nothing. `poses` throws std::runtime_error where there are none.
scenario::SolidDrawing make_drawing(const SharedModel& compiled);

}  // namespace rehearse::mujoco
