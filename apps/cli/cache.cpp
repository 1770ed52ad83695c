#include "apps/cli/cache.hpp"

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "rehearse/experiment/folder_cache.hpp"

namespace rehearse::apps {
namespace {

std::optional<std::filesystem::path> variable(const char* name) {
  const char* value = std::getenv(name);
  if (!value) return {};
  return value;
}

std::filesystem::path folder() {
  if (const auto named = variable("REHEARSE_CACHE")) return *named;
  if (const auto caches = variable("XDG_CACHE_HOME"); caches && !caches->empty()) return *caches / "rehearse";
  if (const auto home = variable("HOME"); home && !home->empty()) return *home / ".cache" / "rehearse";
  return {};
}

}  // namespace

std::shared_ptr<const Cache> cache() {
  const std::filesystem::path found = folder();
  return found.empty() ? nullptr : std::make_shared<experiment::FolderCache>(found);
}

}  // namespace rehearse::apps
