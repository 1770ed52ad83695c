#include "rehearse/files/write.hpp"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::files {
namespace {

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
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);  // some file systems cannot; the rename is still in one step
  ::close(descriptor);
}

/// Gives a file the permissions of the one that it replaces, if there is one.
void take_permissions(const std::filesystem::path& file, const std::filesystem::path& replaced) {
  struct stat old = {};
  if (::lstat(replaced.c_str(), &old) == 0 && S_ISREG(old.st_mode)) ::chmod(file.c_str(), old.st_mode & 07777);
}

void replace(const std::filesystem::path& path, const std::string& suffix, std::string_view bytes,
             Durability durability) {
  const bool durable = durability == Durability::power;
  Temporary temporary(path.string() + suffix);
  {
    ::unlink(temporary.path().c_str());  // whatever a kill, or somebody, left there
    RegularFile file(temporary.path(), O_WRONLY | O_CREAT | O_EXCL);
    if (file.open()) take_permissions(temporary.path(), path);
    if (!file.open() || !file.write(bytes) || (durable && !file.sync()) || !file.close()) cannot("write", path);
  }
  if (!temporary.rename(path)) cannot("write", path);
  if (durable) sync_folder(path);
}

}  // namespace

std::filesystem::path without_slash(const std::filesystem::path& path) {
  return path.has_filename() ? path : path.parent_path();
}

bool holds(const std::filesystem::path& path, std::string_view bytes) {
  try {
    std::error_code none;
    return std::filesystem::file_size(path, none) == bytes.size() && !none && read_file(path) == bytes;
  } catch (const InvalidInput&) {
    return false;
  }
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

FolderLock::FolderLock(const std::filesystem::path& folder, Kind kind) {
  RegularFile lock(folder / "lock", O_RDWR | O_CREAT);
  if (!lock.open()) throw InvalidInput(fmt::format("cannot write {}: {}", (folder / "lock").string(), lock.problem()));
  file_ = lock.release();
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

bool FolderLock::is_held(const std::filesystem::path& folder) {
  RegularFile lock(folder / "lock");
  if (!lock.open()) return false;
  const int file = lock.release();
  const bool held = ::flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(file);  // which also unlocks it
  return held;
}

FolderLock::FolderLock(FolderLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

}  // namespace rehearse::files
