#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "rehearse/core/types.hpp"

namespace rehearse::system {

/// A row that a simulator could not simulate.
struct Fault {
  Vector x, u;
  std::string why;  // what it threw; empty: it gave no change that can be used
};

/// Keeps one of the rows that a simulator could not simulate, for people: the smallest, number by number, so
/// that it does not depend on threads. Any thread.
class FirstFault {
 public:
  void add(const ConstVectorView& x, const ConstVectorView& u, const std::string& why);
  std::optional<Fault> get() const;
  void clear();

 private:
  mutable std::mutex mutex_;
  std::optional<Fault> fault_;
};

}  // namespace rehearse::system
