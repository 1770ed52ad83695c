#include "rehearse/report/files.hpp"

#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "rehearse/core/options.hpp"
#include "rehearse/files/regular_file.hpp"

namespace rehearse::report {
namespace {

/// no_number(row): the first cell that is neither a number nor empty.
template <class NoNumber>
Json numbers(const files::Table& table, std::size_t position, NoNumber no_number) {
  Json column = Json::array();
  bool whole = true;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string& cell = table.rows[row][position];
    double value = 0;
    const bool is_number = from_text(cell, value);
    if (whole && !is_number && !cell.empty()) no_number(row), whole = false;
    column.push_back(is_number ? rounded(value) : Json());
  }
  return column;
}

/// Limits the depth, since code that walks through values calls itself for each level. No file of ours is as deep.
bool check_depth(int depth, Json::parse_event_t, Json&) {
  constexpr int kDeepest = 64;
  if (depth > kDeepest) throw InvalidInput(fmt::format("it is nested deeper than {} levels", kDeepest));
  return true;
}

Json texts(const files::Table& table, std::size_t position) {
  Json column = Json::array();
  for (const auto& row : table.rows) column.push_back(row[position]);
  return column;
}

}  // namespace

std::string read_text(const std::filesystem::path& path) { return files::RegularFile(path).read(); }

files::Table read_table(const std::filesystem::path& path) { return files::read_csv(read_text(path)); }

Json read_json(const std::filesystem::path& path) {
  try {
    return Json::parse(read_text(path), check_depth);
  } catch (const Json::out_of_range&) {
    throw InvalidInput("it has a number that is too large");
  } catch (const Json::parse_error&) {
    throw InvalidInput("it is truncated or no JSON");
  }
}

Json rounded(double value, int digits) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  if (!std::isfinite(value)) return {};
  if (value == std::round(value) && std::abs(value) < kExact) return static_cast<std::int64_t>(value);
  double nearest = 0;
  from_text(fmt::format("{:.{}g}", value, digits), nearest);
  return nearest;
}

Json rounded(Json json) {
  if (json.is_number_float()) return rounded(json.get<double>());
  if (json.is_structured())
    for (Json& item : json) item = rounded(std::move(item));
  return json;
}

Json columns(const files::Table& table, const std::filesystem::path& where, Problems& problems,
             const std::string& of_texts) {
  Json all = Json::object();
  for (std::size_t i = 0; i < table.header.size(); ++i) {
    const std::string& name = table.header[i];
    const auto no_number = [&](std::size_t row) {
      problems.add(where, fmt::format("row {}: {} = {}, must be a number", row + 2, name, table.rows[row][i]));
    };
    all[name] = name == of_texts ? texts(table, i) : numbers(table, i, no_number);
  }
  return all;
}

}  // namespace rehearse::report
