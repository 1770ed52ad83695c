#include "rehearse/experiment/files.hpp"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::experiment {
namespace {

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags) : file_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {}
  ~Descriptor() {
    if (file_ >= 0) ::close(file_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool open() const { return file_ >= 0; }
  bool write(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_, bytes.data(), bytes.size());
      if (written < 0 && errno != EINTR) return false;
      if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
  }
  bool sync() const { return ::fsync(file_) == 0; }

 private:
  int file_;
};

/// A name that goes with this object, unless the file has got another one by then.
class Temporary {
 public:
  explicit Temporary(std::filesystem::path path) : path_(std::move(path)) {}
  ~Temporary() {
    if (!renamed_) ::unlink(path_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  const std::filesystem::path& path() const { return path_; }
  bool rename(const std::filesystem::path& path) { return renamed_ = ::rename(path_.c_str(), path.c_str()) == 0; }

 private:
  std::filesystem::path path_;
  bool renamed_ = false;
};

[[noreturn]] void cannot(const char* verb, const std::filesystem::path& path) {
  throw std::runtime_error(fmt::format("cannot {} {}: {}", verb, path.string(), std::strerror(errno)));
}

void sync_folder(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
  if (descriptor.open()) descriptor.sync();  // some file systems cannot; the rename is still in one step
}

void replace(const std::filesystem::path& path, const std::string& suffix, std::string_view bytes,
             Durability durability) {
  const bool durable = durability == Durability::power;
  Temporary temporary(path.string() + suffix);
  {
    const Descriptor file(temporary.path(), O_WRONLY | O_CREAT | O_TRUNC);
    if (!file.open() || !file.write(bytes) || (durable && !file.sync())) cannot("write", path);
  }
  if (!temporary.rename(path)) cannot("write", path);
  if (durable) sync_folder(path);
}

}  // namespace

std::filesystem::path without_slash(const std::filesystem::path& path) {
  return path.has_filename() ? path : path.parent_path();
}

std::string read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  std::ifstream file(path, std::ios::binary);
  if (!file || !std::filesystem::is_regular_file(path, ignored))
    throw InvalidInput(fmt::format("cannot read {}", path.string()));
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_file(const std::filesystem::path& path, std::string_view bytes, Durability durability) {
  replace(path, ".tmp", bytes, durability);
}

void write_shared_file(const std::filesystem::path& path, std::string_view bytes) {
  std::random_device random;
  replace(path, fmt::format(".{:08x}{:08x}.tmp", random(), random()), bytes, Durability::power);
}

void remove_temporaries(const std::filesystem::path& path) {
  const std::string prefix = path.filename().string() + ".";
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(path.parent_path())) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(prefix) && name.ends_with(".tmp")) found.push_back(entry.path());
  }
  for (const auto& temporary : found) std::filesystem::remove(temporary);
}

bool rename_new(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) != 0) {
    if (errno == EEXIST) return false;
    const bool unsupported = errno == EINVAL || errno == ENOSYS;  // by this file system
    if (!unsupported) cannot("create", to);
    if (std::filesystem::exists(to)) return false;
    if (::rename(from.c_str(), to.c_str()) != 0) cannot("create", to);
  }
  sync_folder(to);
  return true;
}

FolderLock::FolderLock(const std::filesystem::path& folder, Kind kind)
    : file_(::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
  if (file_ < 0) throw InvalidInput(fmt::format("cannot write in {}: {}", folder.string(), std::strerror(errno)));
  for (int attempt = 0; attempt < 40; ++attempt) {  // a process that was just killed may take a moment to go
    if (::flock(file_, (kind == Kind::shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0) return;
    if (errno != EWOULDBLOCK && errno != EINTR) return;  // the file system has no locks
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  ::close(file_);
  throw InvalidInput(fmt::format("{} is in use by another process", folder.string()));
}

FolderLock::~FolderLock() {
  if (file_ >= 0) ::close(file_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

}  // namespace rehearse::experiment
