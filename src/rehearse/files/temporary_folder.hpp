#pragma once

#include <filesystem>
#include <string_view>

namespace rehearse::files {

/// A folder of its own for files that somebody else is to read, below TMPDIR or /tmp; removed with this object, with
/// all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder();  // throws std::system_error
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// A file that its owner may read and execute, by its path from here, which must not lead out of the folder.
  void add(const std::filesystem::path& file, std::string_view bytes) const;

 private:
  std::filesystem::path path_;
};

/// Removes all that there are, for a process that ends without destructors. Not for handlers of signals.
void remove_temporary_folders() noexcept;

/// True if a path stays within its folder: relative, and without "..".
bool stays_within(const std::filesystem::path& path);

}  // namespace rehearse::files
