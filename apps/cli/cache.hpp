#pragma once

#include <filesystem>

namespace rehearse::apps {

/// The folder in which learners keep what other runs can begin with: one of this very program, which need not exist, in
/// $REHEARSE_CACHE or else the user's cache. Empty: there is none, as $REHEARSE_CACHE = off or none says, or no place
/// for it. The first call removes the oldest of what the cache has too much of. Any thread.
std::filesystem::path cache_folder();

}  // namespace rehearse::apps
