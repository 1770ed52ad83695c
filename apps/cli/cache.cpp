#include "apps/cli/cache.hpp"

#include <cstdlib>
#include <string_view>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/cache.hpp"
#include "rehearse/files/checksum.hpp"
#include "rehearse/files/regular_file.hpp"

namespace rehearse::apps {
namespace {

namespace fs = std::filesystem;

std::string_view variable(const char* name) {
  const char* text = std::getenv(name);
  return text ? text : "";
}

fs::path root() {
  if (std::getenv("REHEARSE_CACHE")) {
    const std::string_view given = variable("REHEARSE_CACHE");
    return given == "off" ? fs::path() : fs::path(given);
  }
  if (const auto cache = variable("XDG_CACHE_HOME"); !cache.empty()) return fs::path(cache) / "rehearse";
  if (const auto home = variable("HOME"); !home.empty()) return fs::path(home) / ".cache" / "rehearse";
  return {};
}

/// Another program may give other bits.
fs::path own_folder() {
  const fs::path folder = root();
  if (folder.empty()) return {};
  try {
    experiment::prune_cache(experiment::cache_folders(folder));
    const std::string program = files::read_file("/proc/self/exe", files::Links::follow);
    return experiment::cache_folder_of(folder, files::checksum(program));
  } catch (const InvalidInput&) {
    return {};
  }
}

}  // namespace

fs::path cache_folder() {
  static const fs::path folder = own_folder();
  return folder;
}

}  // namespace rehearse::apps
