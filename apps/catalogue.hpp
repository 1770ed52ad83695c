#pragma once

#include "rehearse/experiment/catalogue.hpp"

namespace rehearse::apps {

/// Every robot and learner of this build.
experiment::Catalogue catalogue();

}  // namespace rehearse::apps
