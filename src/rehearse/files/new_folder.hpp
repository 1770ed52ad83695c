#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace rehearse::files {

/// A folder that appears with all that is in it, or not at all. It is made beside its place, on the same file system,
/// under a hidden name, .NAME.PROCESS, so that it is known before any work whether it can be written. What has not
/// appeared is removed with this object. A process makes one folder of a name at a time.
class NewFolder {
 public:
  explicit NewFolder(const std::filesystem::path& path);  // throws InvalidInput if it cannot be made
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  /// Where its files are until it appears.
  const std::filesystem::path& hidden() const { return hidden_; }

  /// Gives it its name; false if something of that name exists. Throws std::runtime_error.
  bool appear();

 private:
  std::filesystem::path path_, hidden_, first_made_;
};

/// NAME of ".NAME.PROCESS", or nothing.
std::optional<std::string> name_of_hidden(const std::string& entry);

}  // namespace rehearse::files
