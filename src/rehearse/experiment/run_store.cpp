#include "rehearse/experiment/run_store.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/cache.hpp"
#include "rehearse/experiment/spec_file.hpp"
#include "rehearse/files/checksum.hpp"
#include "rehearse/files/seal.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStoreKind = "kept";

/// The bytes that a file keeps for this owner; nothing where it is missing, damaged, another's or not to be read.
std::optional<std::string> read_kept(const fs::path& path, const std::string& owner) {
  if (path.empty()) return {};
  try {
    const std::string bytes = files::read_file(path);
    const std::string_view body = files::unseal(kStoreKind, bytes);
    if (!body.starts_with(owner + '\0')) return {};
    return std::string(body.substr(owner.size() + 1));
  } catch (const InvalidInput&) {
    return {};
  }
}

/// The owner as older versions named it: with until_solved.
std::string older_owner(const Spec& spec) {
  Spec older = spec.without_end();
  older.until_solved = spec.until_solved;
  return to_toml(older);
}

void write_cached(const fs::path& path, const std::string& bytes) {
  try {
    fs::create_directories(path.parent_path());
    files::write_shared_file(path, bytes);
    prune_cache({path.parent_path()});
  } catch (const std::exception&) {  // a run does not depend on its cache
  }
}

}  // namespace

RunStore::RunStore(const Spec& spec, CacheFolder cache)
    : owner_(to_toml(spec.without_end())), older_owner_(older_owner(spec)), cache_(std::move(cache)) {}

fs::path RunStore::kept(const std::string& name) const {
  return folder_.empty() ? fs::path() : folder_ / "kept" / name;
}

fs::path RunStore::cached(const std::string& name) {
  if (!cache_folder_) cache_folder_ = cache_ ? cache_() : fs::path();
  if (cache_folder_->empty()) return {};
  return *cache_folder_ / cache_entry(name, files::checksum(owner_));
}

std::optional<std::string> RunStore::read(const std::string& name) {
  for (const std::string& owner : {owner_, older_owner_})
    if (auto bytes = read_kept(kept(name), owner)) return bytes;
  return read_kept(cached(name), owner_);
}

void RunStore::write(const std::string& name, const std::string& bytes) {
  const std::string sealed = files::seal(kStoreKind, owner_ + '\0' + bytes);
  if (const fs::path path = kept(name); !path.empty()) {
    try {
      fs::create_directories(path.parent_path());
      files::write_file(path, sealed, files::Durability::power);
    } catch (const std::runtime_error& error) {
      throw RunFailed(error.what(), true);  // of the disk, not of the learner
    }
  }
  if (const fs::path path = cached(name); !path.empty()) write_cached(path, sealed);
}

}  // namespace rehearse::experiment
