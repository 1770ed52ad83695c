#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rehearse {

/// Wrong input. The message holds every violation found, one a line: the name, the value and the bound.
class InvalidInput : public std::runtime_error {
 public:
  explicit InvalidInput(const std::string& violation);
  explicit InvalidInput(const std::vector<std::string>& violations);

  /// The violations, one for each line of the message.
  std::vector<std::string> violations() const;
};

/// Collects violations, so that all of them are reported at once.
class Violations {
 public:
  void add(std::string violation) { list_.push_back(std::move(violation)); }
  void add(const std::vector<std::string>& violations);
  void add(const InvalidInput& error) { add(error.violations()); }
  void require(bool holds, const std::string& violation) {
    if (!holds) add(violation);
  }
  /// Does the work, and adds the violations that it throws. False: it threw some.
  template <class Work>
  bool attempt(Work&& work) {
    try {
      std::forward<Work>(work)();
      return true;
    } catch (const InvalidInput& error) {
      add(error);
      return false;
    }
  }
  const std::vector<std::string>& list() const { return list_; }
  bool empty() const { return list_.empty(); }
  void throw_if_any() const;

 private:
  std::vector<std::string> list_;
};

}  // namespace rehearse
