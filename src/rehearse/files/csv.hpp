#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::files {

/// Comma-separated text, a header and rows of as many cells.
class Csv {
 public:
  explicit Csv(const std::vector<std::string>& header) { row(header); }

  void row(const std::vector<std::string>& cells);
  const std::string& text() const { return text_; }

  static std::string cell(Index value);
  static std::string cell(double value);  // empty if it is NaN
  template <class T>
  static std::string cell(const std::optional<T>& value) {
    return value ? cell(*value) : std::string{};
  }

 private:
  std::string text_;
};

}  // namespace rehearse::files
