#include "rehearse/experiment/folder_cache.hpp"

#include <exception>

#include <fmt/format.h>

#include "rehearse/core/checksum.hpp"
#include "rehearse/experiment/files.hpp"

namespace rehearse::experiment {
namespace {

/// "LENGTH\nKEY" stands before an entry: two keys of one checksum do not take each other's entries.
std::string head(std::string_view key) { return fmt::format("{}\n{}", key.size(), key); }

}  // namespace

std::filesystem::path FolderCache::file_of(std::string_view key) const {
  return folder_ / fmt::format("{:016x}", checksum(key));
}

std::optional<std::string> FolderCache::read(std::string_view key) const {
  try {
    if (!std::filesystem::exists(file_of(key))) return {};
    std::string bytes = read_file(file_of(key));
    const std::string before = head(key);
    if (!bytes.starts_with(before)) return {};
    return bytes.substr(before.size());
  } catch (const std::exception&) {
    return {};
  }
}

void FolderCache::write(std::string_view key, std::string_view bytes) const {
  try {
    std::filesystem::create_directories(folder_);
    write_shared_file(file_of(key), head(key).append(bytes));
  } catch (const std::exception&) {
    remove(key);
  }
}

void FolderCache::remove(std::string_view key) const {
  std::error_code ignored;
  std::filesystem::remove(file_of(key), ignored);
}

}  // namespace rehearse::experiment
