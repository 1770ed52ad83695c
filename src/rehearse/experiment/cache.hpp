#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rehearse::experiment {

/// The most bytes that a cache keeps in all: some 200 archives of the hexapod's size.
constexpr std::uintmax_t kMostCacheBytes = std::uintmax_t{1} << 30;

/// The cache folder below `root` for what one program keeps; key: of its bytes.
std::filesystem::path cache_folder_of(const std::filesystem::path& root, std::uint64_t key);

/// All such folders below `root`.
std::vector<std::filesystem::path> cache_folders(const std::filesystem::path& root);

/// Removes the oldest of what stores keep in these folders until no more bytes are left than `most`. Nothing else is
/// touched, and nothing thrown.
void prune_cache(const std::vector<std::filesystem::path>& folders, std::uintmax_t most = kMostCacheBytes);

/// The name of what a store keeps for a spec; owner: of that.
std::string cache_entry(const std::string& name, std::uint64_t owner);

}  // namespace rehearse::experiment
