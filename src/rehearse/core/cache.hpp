#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rehearse {

/// Keeps bytes that took long to compute, by a key that names everything that they depend on. Whether an entry is there
/// decides how long something takes and nothing else. Any thread, several processes.
class Cache {
 public:
  virtual ~Cache() = default;
  /// Nothing if there is no such entry, or it cannot be read. Whoever reads must check what it gets.
  virtual std::optional<std::string> read(std::string_view key) const = 0;
  /// Replaces the entry in one step; where that fails there is none.
  virtual void write(std::string_view key, std::string_view bytes) const = 0;
  virtual void remove(std::string_view key) const = 0;
};

}  // namespace rehearse
