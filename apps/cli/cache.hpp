#pragma once

#include <memory>

#include "rehearse/core/cache.hpp"

namespace rehearse::apps {

/// The user's: the folder that REHEARSE_CACHE names (empty: none), else `rehearse` in XDG_CACHE_HOME or in ~/.cache.
std::shared_ptr<const Cache> cache();

}  // namespace rehearse::apps
