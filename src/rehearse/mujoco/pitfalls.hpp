#pragma once

#include <string>

namespace rehearse::mujoco {

/// Throws InvalidInput with all of a model that MuJoCo crashes on, or makes for minutes: textures and height fields of
/// more points than it can count, and joints of URDF of an unknown type. Files that the model includes are read, too.
/// Malformed files are left to MuJoCo.
void refuse_pitfalls(const std::string& path);

}  // namespace rehearse::mujoco
