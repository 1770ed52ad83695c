#include "rehearse/experiment/cache.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDigits = 16;

bool is_key(std::string_view text) {
  return text.size() == kDigits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// "NAME-KEY", or what a process that was killed left of it: "NAME-KEY.KEY.tmp".
bool is_entry(std::string_view name) {
  if (name.ends_with(".tmp")) {
    const std::size_t dot = name.find('.');
    if (!is_key(name.substr(dot + 1, name.size() - dot - 5))) return false;
    name = name.substr(0, dot);
  }
  const std::size_t dash = name.rfind('-');
  return dash != std::string_view::npos && dash > 0 && is_key(name.substr(dash + 1));
}

struct Entry {
  fs::path path;
  fs::file_time_type written;
  std::uintmax_t bytes = 0;
};

/// The entries of a folder, as far as it can be read; none, and no error, if it cannot.
std::vector<fs::directory_entry> contents(const fs::path& folder) {
  std::vector<fs::directory_entry> all;
  std::error_code none;
  for (fs::directory_iterator at(folder, none), end; !none && at != end; at.increment(none)) all.push_back(*at);
  return all;
}

void add_entries(const fs::path& folder, std::vector<Entry>& entries) {
  std::error_code none;
  for (const fs::directory_entry& entry : contents(folder)) {
    if (!is_entry(entry.path().filename().string()) || !fs::is_regular_file(entry.symlink_status(none))) continue;
    entries.push_back({entry.path(), entry.last_write_time(none), entry.file_size(none)});
    if (none) entries.pop_back();  // gone by now
  }
}

}  // namespace

fs::path cache_folder_of(const fs::path& root, std::uint64_t key) { return root / fmt::format("{:016x}", key); }

std::string cache_entry(const std::string& name, std::uint64_t owner) { return fmt::format("{}-{:016x}", name, owner); }

std::vector<fs::path> cache_folders(const fs::path& root) {
  std::vector<fs::path> folders;
  std::error_code none;
  for (const fs::directory_entry& entry : contents(root))
    if (is_key(entry.path().filename().string()) && fs::is_directory(entry.symlink_status(none)))
      folders.push_back(entry.path());
  return folders;
}

void prune_cache(const std::vector<fs::path>& folders, std::uintmax_t most) {
  std::vector<Entry> entries;
  for (const fs::path& folder : folders) add_entries(folder, entries);
  std::uintmax_t bytes = 0;
  for (const Entry& entry : entries) bytes += entry.bytes;
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.written < b.written; });
  std::error_code none;
  for (std::size_t i = 0; i < entries.size() && bytes > most; ++i) {
    fs::remove(entries[i].path, none);
    bytes -= entries[i].bytes;
  }
}

}  // namespace rehearse::experiment
