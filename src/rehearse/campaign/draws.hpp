#pragma once

#include "rehearse/campaign/file.hpp"
#include "rehearse/experiment/spec.hpp"

namespace rehearse::campaign {

/// The option that [draw] gives runs of this seed. It depends on the seed and the option's name alone.
experiment::FileOption drawn(const Draw& draw, Index seed);

}  // namespace rehearse::campaign
