#pragma once

#include <string>
#include <vector>

#include "rehearse/experiment/record.hpp"

namespace rehearse::apps {

/// The predicted risk of a limit with its interval: "1.2 % (0.5 to 3)"; empty where it is not known. interval: what is
/// said in front of it, "95 %: ".
std::string risk_text(const experiment::LimitRecord& limit, const char* interval = "");

/// The limits that a trial broke: "broke track, speed"; empty where it kept them all.
std::string broken_text(const std::vector<experiment::LimitRecord>& limits);

}  // namespace rehearse::apps
