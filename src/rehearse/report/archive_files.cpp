#include "rehearse/report/archive_files.hpp"

#include <cmath>

#include <fmt/format.h>

namespace rehearse::report {
namespace {

namespace fs = std::filesystem;

constexpr int kDigits = 4;  // thousands of elites

/// A column without a gap.
std::vector<double> whole_column(const files::Table& table, const std::string& name) {
  std::vector<double> values;
  for (const auto& value : table.numbers(name)) {
    if (!value || !std::isfinite(*value))
      throw InvalidInput(fmt::format("row {} has no finite {}", values.size() + 2, name));
    values.push_back(*value);
  }
  return values;
}

Json rounded_column(const files::Table& table, const std::string& name) {
  Json all = Json::array();
  for (const double value : whole_column(table, name)) all.push_back(rounded(value, kDigits));
  return all;
}

/// The columns before what the archive promises.
std::vector<std::string> descriptors_of(const files::Table& elites) {
  const int promised = elites.column("promised");
  if (promised < 1) throw InvalidInput("there are no descriptors before a column promised");
  return {elites.header.begin(), elites.header.begin() + promised};
}

Json elites_json(const files::Table& elites) {
  if (elites.rows.empty()) throw InvalidInput("it has no elites");
  Json json = {{"descriptors", Json::array()}};
  for (const std::string& name : descriptors_of(elites))
    json["descriptors"].push_back({{"name", name}, {"values", rounded_column(elites, name)}});
  for (const char* name : {"promised", "expected"}) json[name] = rounded_column(elites, name);
  return json;
}

Json tried_json(const files::Table& tried, std::size_t elites, Problems& problems) {
  for (const char* name : {"trial", "promised", "learned"}) whole_column(tried, name);
  for (const double elite : whole_column(tried, "elite"))
    if (elite < 1 || elite > static_cast<double>(elites) || elite != std::round(elite))
      throw InvalidInput(fmt::format("elite {} is not among the {} of elites.csv", elite, elites));
  return columns(tried, "tried.csv", problems);
}

/// The number of niches and their bounds; for a grid the bins of each descriptor.
Json space_json(const ArchiveSpace& bytes, const Json& tables) {
  const std::size_t elites = tables["promised"].size(), descriptors = tables["descriptors"].size();
  if (bytes.elites != static_cast<Index>(elites) || bytes.bounds.size() != descriptors)
    throw InvalidInput(fmt::format("it has {} elites of {} descriptors, elites.csv {} of {}", bytes.elites,
                                   bytes.bounds.size(), elites, descriptors));
  Json space = {{"niches", bytes.niches}, {"bounds", Json::array()}};
  for (const Interval& bound : bytes.bounds)
    space["bounds"].push_back({rounded(bound.low, kDigits), rounded(bound.high, kDigits)});
  if (!bytes.bins.empty()) space["bins"] = bytes.bins;
  return space;
}

}  // namespace

Json archive_json(const fs::path& folder, const ArchiveReader& read_archive, Problems& problems) {
  const auto has = [&](const char* file) { return fs::exists(folder / file); };
  const bool has_tables = has("elites.csv") || has("tried.csv");
  if (!has_tables && !has("archive.bin")) return {};
  std::optional<ArchiveSpace> bytes;
  if (read_archive)
    bytes = problems.value_or_problem("archive.bin", [&] { return read_archive(read_text(folder / "archive.bin")); });
  if (!has_tables) return {};  // before the first trial is done, and in folders of older versions
  auto tables = problems.value_or_problem("elites.csv", [&] { return elites_json(read_table(folder / "elites.csv")); });
  if (!tables) return {};
  std::optional<Json> space;
  if (bytes) space = problems.value_or_problem("archive.bin", [&] { return space_json(*bytes, *tables); });
  const auto tried = problems.value_or_problem("tried.csv", [&] {
    return tried_json(read_table(folder / "tried.csv"), (*tables)["promised"].size(), problems);
  });
  (*tables)["space"] = space.value_or(Json());
  (*tables)["tried"] = tried.value_or(Json());
  return *tables;
}

}  // namespace rehearse::report
