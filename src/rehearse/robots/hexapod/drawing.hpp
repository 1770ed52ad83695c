#pragma once

#include <vector>

#include "rehearse/core/types.hpp"
#include "rehearse/scenario/drawing.hpp"

namespace rehearse::robots::hexapod {

/// Trunk, segments and feet of the hexapod, without the legs that are missing.
scenario::SolidDrawing drawing(const std::vector<Index>& missing);

}  // namespace rehearse::robots::hexapod
