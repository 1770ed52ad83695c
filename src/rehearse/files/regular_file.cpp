#include "rehearse/files/regular_file.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::files {
namespace {

std::string problem_of(int error, Links links) {
  if (error == ENOENT) return "it is not there";
  if (error == ELOOP && links == Links::refuse) return "it is a link";
  return std::strerror(error);
}

bool is_regular(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

}  // namespace

RegularFile::RegularFile(const std::filesystem::path& path, int flags, Links links) {
  const int follow = links == Links::refuse ? O_NOFOLLOW : 0;
  descriptor_ = ::open(path.c_str(), flags | follow | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, 0644);
  if (descriptor_ < 0) {
    problem_ = problem_of(errno, links);
  } else if (!is_regular(descriptor_)) {
    ::close(std::exchange(descriptor_, -1));
    problem_ = "it is no regular file";
  }
}

RegularFile::~RegularFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::string RegularFile::read() const {
  if (!open()) throw InvalidInput(problem_);
  std::string all;
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0) all.reserve(static_cast<std::size_t>(status.st_size));
  std::array<char, 1 << 16> part;
  while (true) {
    const ssize_t bytes = ::pread(descriptor_, part.data(), part.size(), static_cast<off_t>(all.size()));
    if (bytes == 0) return all;
    if (bytes > 0) all.append(part.data(), static_cast<std::size_t>(bytes));
    if (bytes < 0 && errno != EINTR) throw InvalidInput(std::strerror(errno));
  }
}

bool RegularFile::ends_with(char last) const {
  struct stat status {};
  char found = 0;
  return ::fstat(descriptor_, &status) == 0 && status.st_size > 0 &&
         ::pread(descriptor_, &found, 1, status.st_size - 1) == 1 && found == last;
}

bool RegularFile::write(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool RegularFile::sync() const { return ::fsync(descriptor_) == 0; }

bool RegularFile::close() { return ::close(release()) == 0; }

int RegularFile::release() { return std::exchange(descriptor_, -1); }

std::string read_file(const std::filesystem::path& path, Links links) {
  const RegularFile file(path, O_RDONLY, links);
  try {
    return file.read();
  } catch (const InvalidInput& error) {
    throw InvalidInput(fmt::format("cannot read {}: {}", path.string(), error.what()));
  }
}

}  // namespace rehearse::files
