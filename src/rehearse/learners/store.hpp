#pragma once

#include <optional>
#include <string>

namespace rehearse::learners {

/// Keeps what takes a learner long before its first trial and is not in the episodes, so that a run that was killed
/// goes on from there, and another that would compute the same begins with it. It belongs to one setting and its
/// options. What is lost is computed again: a store changes no result.
class Store {
 public:
  virtual ~Store() = default;

  /// What was last written under `name`; nothing where there is none, or it is damaged.
  virtual std::optional<std::string> read(const std::string& name) = 0;

  /// Replaces it in one step.
  virtual void write(const std::string& name, const std::string& bytes) = 0;
};

}  // namespace rehearse::learners
