#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "rehearse/files/regular_file.hpp"

namespace rehearse::files {

/// A folder's path without a "/" at its end.
std::filesystem::path without_slash(const std::filesystem::path& path);

/// True if a file can be read and has these bytes.
bool holds(const std::filesystem::path& path, std::string_view bytes);

enum class Durability {
  process,  // survives the process: whenever it is killed, the file holds its old bytes or the new ones
  power,    // and a power failure, at the price of waiting for the disk
};

/// Replaces a file, or a link of that name, in one step. Throws std::runtime_error (a full disk).
void write_file(const std::filesystem::path& path, std::string_view bytes, Durability durability = Durability::process);

/// The same for a file that several processes may replace at once, durably. A killed process leaves a temporary file,
/// which `remove_temporaries` removes when no other process is at work.
void write_shared_file(const std::filesystem::path& path, std::string_view bytes);
void remove_temporaries(const std::filesystem::path& path);

/// Renames a folder unless something of that name exists; then returns false.
bool rename_new(const std::filesystem::path& from, const std::filesystem::path& to);

/// A lock held by the one process that may write a folder, or by several that share it; released when the process ends
/// in any way. Without effect on a file system that has no locks. Movable.
class FolderLock {
 public:
  enum class Kind { exclusive, shared };
  explicit FolderLock(const std::filesystem::path& folder, Kind kind = Kind::exclusive);  // InvalidInput: it is in use
  ~FolderLock();

  /// True if a process holds it alone now. Neither waits nor writes.
  static bool is_held(const std::filesystem::path& folder);

  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  int file_ = -1;
};

}  // namespace rehearse::files
