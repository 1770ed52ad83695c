#pragma once
// Reading of a folder's files; an unreadable one becomes a problem. For the sources of this room.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
#include "rehearse/files/table.hpp"
#include "rehearse/report/page_data.hpp"

namespace rehearse::report {

using Json = nlohmann::ordered_json;

/// A whole file. Throws InvalidInput.
std::string read_text(const std::filesystem::path& path);

/// A table that is whole. Throws InvalidInput.
files::Table read_table(const std::filesystem::path& path);

/// Throws InvalidInput.
Json read_json(const std::filesystem::path& path);

/// The value to so many significant digits, whole numbers exactly; null if it is not finite.
Json rounded(double value, int digits = 6);

/// Every number in it rounded.
Json rounded(Json json);

/// Problems, each with where it is.
class Problems {
 public:
  void add(const std::filesystem::path& where, std::string what) { list_.push_back({where.string(), std::move(what)}); }

  /// The value of `read`; if it throws InvalidInput, none and a problem.
  template <class Read>
  auto value_or_problem(const std::filesystem::path& where, Read read) -> std::optional<decltype(read())> {
    try {
      return read();
    } catch (const InvalidInput& error) {
      add(where, error.what());
      return std::nullopt;
    }
  }

  const std::vector<Problem>& list() const { return list_; }

 private:
  std::vector<Problem> list_;
};

/// Column name → cells. All are numbers or empty (null) but those of the column `of_texts`; what should be a number and
/// is none becomes null, and the first one of a column a problem.
Json columns(const files::Table& table, const std::filesystem::path& where, Problems& problems,
             const std::string& of_texts = "");

}  // namespace rehearse::report
