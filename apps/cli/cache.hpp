#pragma once

#include <filesystem>

namespace rehearse::apps {

/// Where learners keep what other runs can begin with: a folder of this very program, which need not exist, in
/// $REHEARSE_CACHE or else the user's cache. Empty: nowhere, as $REHEARSE_CACHE = off or none says, or there is no such
/// place. The first call removes the oldest of what the cache has too much of. Any thread.
std::filesystem::path cache_folder();

}  // namespace rehearse::apps
