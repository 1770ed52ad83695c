#include "rehearse/files/new_folder.hpp"

#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::files {
namespace {

namespace fs = std::filesystem;

/// The outermost folder of a path that is not there.
fs::path first_missing(const fs::path& path) {
  fs::path missing;
  for (fs::path folder = path; !folder.empty() && !fs::exists(folder); folder = folder.parent_path()) missing = folder;
  return missing;
}

/// Removes folders from `folder` outwards, up to `last`, as long as nothing else is in them.
void remove_empty(fs::path folder, const fs::path& last) {
  std::error_code failed;
  while (fs::remove(folder, failed) && folder != last) folder = folder.parent_path();
}

}  // namespace

NewFolder::NewFolder(const fs::path& path) : path_(without_slash(path)) {
  const fs::path folder = path_.parent_path();
  hidden_ = folder / fmt::format(".{}.{}", path_.filename().string(), ::getpid());
  try {
    first_made_ = first_missing(folder);
    fs::remove_all(hidden_);
    fs::create_directories(hidden_);
  } catch (const fs::filesystem_error& error) {
    throw InvalidInput(fmt::format("cannot create {}: {}", path_.string(), error.code().message()));
  }
}

NewFolder::~NewFolder() {
  if (hidden_.empty()) return;
  std::error_code ignored;
  fs::remove_all(hidden_, ignored);
  if (!first_made_.empty()) remove_empty(path_.parent_path(), first_made_);
}

bool NewFolder::appear() {
  if (!rename_new(hidden_, path_)) return false;
  hidden_.clear();
  return true;
}

std::optional<std::string> name_of_hidden(const std::string& entry) {
  const std::size_t dot = entry.rfind('.');
  if (!entry.starts_with('.') || dot < 2 || dot + 1 == entry.size()) return std::nullopt;
  if (entry.find_first_not_of("0123456789", dot + 1) != std::string::npos) return std::nullopt;
  return entry.substr(1, dot - 1);
}

}  // namespace rehearse::files
