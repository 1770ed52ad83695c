#pragma once

#include <optional>

#include "rehearse/core/types.hpp"
#include "rehearse/scenario/drawing.hpp"

namespace rehearse::robots::hexapod {

/// Trunk, segments and feet of the hexapod, without the leg that is missing.
scenario::SolidDrawing drawing(std::optional<Index> missing);

}  // namespace rehearse::robots::hexapod
