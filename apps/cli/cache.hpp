#pragma once

#include <filesystem>

namespace rehearse::apps {

/// The folder in which learners keep results for other runs of this very program, in $REHEARSE_CACHE or else the user's
/// cache; it need not exist. Empty: there is none, because $REHEARSE_CACHE is off or none, or there is no place for it.
/// The first call removes the oldest files if the cache is too large. Any thread.
std::filesystem::path cache_folder();

}  // namespace rehearse::apps
