#pragma once
// Violations found in a recording, row by row. For the sources of this room.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::recording {

/// Keeps the first row of each kind of violation and counts the other rows: a column in a wrong unit has thousands.
class Problems {
 public:
  explicit Problems(std::string source) : source_(std::move(source)) {}

  /// row: the header is 1; 0: it is about no row.
  void add(Index row, const std::string& kind, const std::string& message);
  bool empty() const { return found_.empty(); }

  /// A line a kind, in the order of the rows.
  std::vector<std::string> lines() const;

  /// InvalidInput with these.
  void throw_if_any() const;

 private:
  struct First {
    Index row;
    std::string message;
    std::vector<Index> rows;  // not in order, some twice
  };
  std::string source_;
  std::map<std::string, First> found_;  // by kind
};

}  // namespace rehearse::recording
