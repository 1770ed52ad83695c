#include "rehearse/files/temporary_folder.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <mutex>
#include <set>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::files {

namespace fs = std::filesystem;

namespace {

/// The folders that there are.
struct Folders {
  std::mutex mutex;
  std::set<fs::path> paths;
};

Folders& folders() {
  static Folders all;
  return all;
}

void remove_folder(const fs::path& path) noexcept {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::error_code failed;
  const fs::path there = fs::temp_directory_path(failed);
  if (failed) {
    const char* set = std::getenv("TMPDIR");
    throw InvalidInput(fmt::format("TMPDIR = '{}', must be a folder in which files can be made", set ? set : "/tmp"));
  }
  std::string name = (there / "rehearse-XXXXXX").string();
  if (!::mkdtemp(name.data()))
    throw std::system_error(errno, std::generic_category(), "no folder can be made: " + name);
  path_ = name;
  const std::lock_guard lock(folders().mutex);
  folders().paths.insert(path_);
}

TemporaryFolder::~TemporaryFolder() {
  remove_folder(path_);
  const std::lock_guard lock(folders().mutex);
  folders().paths.erase(path_);
}

void remove_temporary_folders() noexcept {
  const std::lock_guard lock(folders().mutex);
  for (const fs::path& path : folders().paths) remove_folder(path);
  folders().paths.clear();
}

void TemporaryFolder::add(const fs::path& file, std::string_view bytes) const {
  if (!stays_within(file)) throw InvalidInput(fmt::format("{} leads out of its folder", file.string()));
  fs::create_directories((path_ / file).parent_path());
  write_file(path_ / file, bytes);
  fs::permissions(path_ / file, fs::perms::owner_all);
}

bool stays_within(const fs::path& path) {
  return !path.empty() && path.is_relative() && std::find(path.begin(), path.end(), "..") == path.end();
}

}  // namespace rehearse::files
