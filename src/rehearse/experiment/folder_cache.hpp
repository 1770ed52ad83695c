#pragma once

#include <filesystem>

#include "rehearse/core/cache.hpp"

namespace rehearse::experiment {

/// A folder with a file for each entry, named by a checksum of its key; the key stands before the bytes. Made when it
/// is first written to. Whatever is wrong with it, a full disk or damaged files, is as if nothing were kept.
class FolderCache final : public Cache {
 public:
  explicit FolderCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::optional<std::string> read(std::string_view key) const override;
  void write(std::string_view key, std::string_view bytes) const override;
  void remove(std::string_view key) const override;

 private:
  std::filesystem::path file_of(std::string_view key) const;

  std::filesystem::path folder_;
};

}  // namespace rehearse::experiment
