#pragma once

#include <map>

#include "rehearse/core/types.hpp"
#include "rehearse/learners/store.hpp"

namespace rehearse::learners {

/// Keeps in memory, and counts.
class MemoryStore final : public Store {
 public:
  std::optional<std::string> read(const std::string& name) override {
    return kept.contains(name) ? std::optional(kept[name]) : std::nullopt;
  }
  void write(const std::string& name, const std::string& bytes) override { kept[name] = bytes, ++writes; }
  std::map<std::string, std::string> kept;
  Index writes = 0;
};

}  // namespace rehearse::learners
