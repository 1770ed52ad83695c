#pragma once

#include <optional>
#include <string>

namespace rehearse::learners {

/// Keeps the results of long computations before a learner's first trial, so that a run that was killed goes on from
/// there, and another run that would compute the same begins with them. It belongs to one setting and its options. What
/// is lost is computed again: a store changes no result. One thread at a time.
class Store {
 public:
  virtual ~Store() = default;

  /// The bytes last written under `name`; nothing if there are none, or they are damaged.
  virtual std::optional<std::string> read(const std::string& name) = 0;

  /// Replaces it in one step.
  virtual void write(const std::string& name, const std::string& bytes) = 0;
};

}  // namespace rehearse::learners
