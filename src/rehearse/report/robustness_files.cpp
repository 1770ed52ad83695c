#include "rehearse/report/robustness_files.hpp"

#include <map>

namespace rehearse::report {
namespace {

/// The texts of a column, which is taken out of the table; none if there is no such column.
std::vector<std::string> taken(files::Table& table, std::string_view name) {
  const int place = table.column(name);
  if (place < 0) return {};
  std::vector<std::string> texts = table.texts(name);
  table.header.erase(table.header.begin() + place);
  for (std::vector<std::string>& row : table.rows) row.erase(row.begin() + place);
  return texts;
}

}  // namespace

Json robustness_json(const std::filesystem::path& folder, Problems& problems) {
  constexpr const char* kFile = "robustness.csv";
  if (!std::filesystem::exists(folder / kFile)) return {};
  auto table = problems.value_or_problem(kFile, [&] {
    files::Table read = read_table(folder / kFile);
    for (const char* name : {"parameter", "factor"})
      if (read.column(name) < 0) throw InvalidInput(std::string("it has no column ") + name);
    return read;
  });
  if (!table) return {};
  if (table->rows.empty()) return {};
  const std::vector<std::string> settings = taken(*table, "settings");  // not in the files of older versions
  const std::vector<std::string> parameters = taken(*table, "parameter");
  std::vector<std::string> names;
  std::map<std::string, files::Table> of_parameter;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    files::Table& part = of_parameter[parameters[i]];
    if (part.header.empty()) names.push_back(parameters[i]), part.header = table->header;
    part.rows.push_back(table->rows[i]);
  }
  Json all = Json::array();
  for (const std::string& name : names)
    all.push_back({{"parameter", name}, {"columns", columns(of_parameter[name], kFile, problems)}});
  return {{"settings", settings.empty() ? "" : settings.front()}, {"parameters", std::move(all)}};
}

}  // namespace rehearse::report
