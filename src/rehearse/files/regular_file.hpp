#pragma once
// How files are opened and read, everywhere.

#include <filesystem>
#include <string>
#include <string_view>

#include <fcntl.h>

namespace rehearse::files {

/// Whether a link may stand for the file: one that a user names may be one, those of a run folder are none. Links among
/// the folders above it are followed.
enum class Links { refuse, follow };

/// A regular file that is open while this lives. Opening it waits for nobody, as a FIFO does, and follows no link
/// unless that is allowed; devices and folders are refused.
class RegularFile {
 public:
  explicit RegularFile(const std::filesystem::path& path, int flags = O_RDONLY, Links links = Links::refuse);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  bool open() const { return descriptor_ >= 0; }
  const std::string& problem() const { return problem_; }  // why it is not open: "it is not there", "it is a link", …

  /// All of it from the start. Throws InvalidInput with the problem, also where it is not open.
  std::string read() const;

  /// Whether this is its last byte.
  bool ends_with(char last) const;

  bool write(std::string_view bytes) const;
  bool sync() const;

  /// The descriptor, which the caller closes from here on.
  int release();

 private:
  int descriptor_ = -1;
  std::string problem_;
};

/// A whole file. Throws InvalidInput: "cannot read PATH: it is not there".
std::string read_file(const std::filesystem::path& path, Links links = Links::refuse);

}  // namespace rehearse::files
