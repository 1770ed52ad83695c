#include "rehearse/experiment/abandoned.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <string>
#include <string_view>

#include <unistd.h>

#include "rehearse/experiment/kept_robot.hpp"
#include "rehearse/files/new_folder.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 7> kFirstFiles = {"lock",           "spec.toml", "spec.toml.tmp", "checkpoint",
                                                         "checkpoint.tmp", kRobotFile,  "robot.toml.tmp"};

bool is_alive(const fs::path& hidden) {
  const std::string digits = hidden.extension().string().substr(1);
  pid_t process = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), process);
  return process <= 0 || ::kill(process, 0) == 0 || errno != ESRCH;
}

bool is_of_a_beginning(const fs::directory_entry& entry) {
  const std::string name = entry.path().filename().string();
  if (name == kRobotFolder) return fs::is_directory(entry.symlink_status());
  const bool folder = std::find(kFirstFolders.begin(), kFirstFolders.end(), name) != kFirstFolders.end();
  if (folder) return fs::is_directory(entry.symlink_status()) && fs::is_empty(entry.path());
  return std::find(kFirstFiles.begin(), kFirstFiles.end(), name) != kFirstFiles.end();
}

bool has_a_beginning(const fs::path& folder) {
  return std::all_of(fs::directory_iterator(folder), fs::directory_iterator(), is_of_a_beginning);
}

/// Removes a hidden folder of the run's own name whose process has ended. Those of other names stay: other machines
/// may be making them, and the numbers of their processes say nothing here. Throws where somebody holds its lock.
void remove_if_abandoned(const fs::directory_entry& entry, const std::string& own_name) {
  if (files::name_of_hidden(entry.path().filename().string()) != own_name) return;
  if (!fs::is_directory(entry.symlink_status()) || is_alive(entry.path()) || !has_a_beginning(entry.path())) return;
  const files::FolderLock lock(entry.path());
  fs::remove_all(entry.path());
}

}  // namespace

void remove_abandoned(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    try {
      remove_if_abandoned(entry, path.filename().string());
    } catch (const std::exception&) {  // somebody else's, or gone by now
    }
  }
}

}  // namespace rehearse::experiment
