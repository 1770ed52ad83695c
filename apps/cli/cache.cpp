#include "apps/cli/cache.hpp"

#include <cstdlib>
#include <string_view>

#include <dlfcn.h>

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

/// The file that this code is in: the program, or the module of Python.
fs::path own_file() {
  Dl_info info{};
  const bool found = ::dladdr(reinterpret_cast<const void*>(&cache_folder), &info) != 0 && info.dli_fname;
  const fs::path file = found ? info.dli_fname : "";
  return file.extension() == ".so" ? file : fs::path("/proc/self/exe");
}

/// Another program may give other bits.
fs::path own_folder() {
  const fs::path folder = root();
  if (folder.empty()) return {};
  try {
    experiment::prune_cache(experiment::cache_folders(folder));
    const std::string program = files::read_file(own_file(), files::Links::follow);
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
