#pragma once

#include <string>
#include <string_view>

#include "rehearse/experiment/catalogue.hpp"

namespace rehearse::campaign {

/// The catalogue with the robot that a campaign names by its file, as seen from the campaign's file. Throws
/// InvalidInput.
experiment::Catalogue with_robot_of(const experiment::Catalogue& catalogue, std::string_view text,
                                    const std::string& source);

}  // namespace rehearse::campaign
