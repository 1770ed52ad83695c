#pragma once
// The one way to open and read files.

#include <filesystem>
#include <string>
#include <string_view>

#include <fcntl.h>

namespace rehearse::files {

/// The handling of a path that is a symbolic link: allowed for files that a user names, refused in run folders. Links
/// among the folders above it are followed.
enum class Links { refuse, follow };

/// A regular file that is open while this lives. Opening never blocks, as it would for a FIFO, and follows no link
/// unless that is allowed; devices and folders are refused.
class RegularFile {
 public:
  explicit RegularFile(const std::filesystem::path& path, int flags = O_RDONLY, Links links = Links::refuse);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  bool open() const { return descriptor_ >= 0; }
  const std::string& problem() const { return problem_; }  // why it is not open: "it is not there", "it is a link", …

  /// The contents from the start. Throws InvalidInput with the problem, also where it is not open.
  std::string read() const;

  /// True if this is its last byte.
  bool ends_with(char last) const;

  bool write(std::string_view bytes) const;
  bool sync() const;
  bool close();  // false: what was written may be lost, as network file systems say no earlier

  /// The descriptor; the caller must close it.
  int release();

 private:
  int descriptor_ = -1;
  std::string problem_;
};

/// A whole file. Throws InvalidInput: "cannot read PATH: it is not there".
std::string read_file(const std::filesystem::path& path, Links links = Links::refuse);

}  // namespace rehearse::files
