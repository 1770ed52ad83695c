#include "rehearse/experiment/unborn.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <string_view>

#include <fmt/format.h>
#include <unistd.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/kept_robot.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 2> kFolders = {"trajectories", "predictions"};
constexpr std::array<std::string_view, 7> kFiles = {"lock",           "spec.toml", "spec.toml.tmp", "checkpoint",
                                                    "checkpoint.tmp", kRobotFile,  "robot.toml.tmp"};

std::string unborn_name(const std::string& name) { return fmt::format(".{}.{}", name, ::getpid()); }

bool is_alive(const fs::path& unborn) {
  const std::string digits = unborn.extension().string().substr(1);
  pid_t process = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), process);
  return process <= 0 || ::kill(process, 0) == 0 || errno != ESRCH;
}

bool is_of_a_beginning(const fs::directory_entry& entry) {
  const std::string name = entry.path().filename().string();
  if (name == kRobotFolder) return fs::is_directory(entry.symlink_status());
  const bool folder = std::find(kFolders.begin(), kFolders.end(), name) != kFolders.end();
  if (folder) return fs::is_directory(entry.symlink_status()) && fs::is_empty(entry.path());
  return std::find(kFiles.begin(), kFiles.end(), name) != kFiles.end();
}

bool has_a_beginning(const fs::path& folder) {
  return std::all_of(fs::directory_iterator(folder), fs::directory_iterator(), is_of_a_beginning);
}

/// Removes an unborn folder of the run's own name whose process has ended. Those of other names stay: other machines
/// may be making them, and the numbers of their processes say nothing here. Throws where somebody holds its lock.
void remove_if_abandoned(const fs::directory_entry& entry, const std::string& own_name) {
  if (name_of_unborn(entry.path().filename().string()) != own_name) return;
  if (!fs::is_directory(entry.symlink_status()) || is_alive(entry.path()) || !has_a_beginning(entry.path())) return;
  const files::FolderLock lock(entry.path());
  fs::remove_all(entry.path());
}

void remove_abandoned(const fs::path& folder, const std::string& own_name) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    try {
      remove_if_abandoned(entry, own_name);
    } catch (const std::exception&) {  // somebody else's, or gone by now
    }
  }
}

}  // namespace

std::optional<std::string> name_of_unborn(const std::string& entry) {
  const std::size_t dot = entry.rfind('.');
  if (!entry.starts_with('.') || dot < 2 || dot + 1 == entry.size()) return std::nullopt;
  if (entry.find_first_not_of("0123456789", dot + 1) != std::string::npos) return std::nullopt;
  return entry.substr(1, dot - 1);
}

fs::path make_unborn(const fs::path& path) {
  const std::string name = path.filename().string();
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  fs::path unborn = path.parent_path() / unborn_name(name);
  try {
    remove_abandoned(folder, name);
    fs::remove_all(unborn);
    for (const char* inner : kFolders) fs::create_directories(unborn / inner);
  } catch (const fs::filesystem_error& error) {
    throw InvalidInput(fmt::format("cannot create {}: {}", path.string(), error.code().message()));
  }
  return unborn;
}

}  // namespace rehearse::experiment
