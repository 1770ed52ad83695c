#include "rehearse/report/robustness_files.hpp"

#include <map>

namespace rehearse::report {

Json robustness_json(const std::filesystem::path& folder, Problems& problems) {
  constexpr const char* kFile = "robustness.csv";
  if (!std::filesystem::exists(folder / kFile)) return {};
  const auto table = problems.value_or_problem(kFile, [&] {
    statistics::Table read = read_table(folder / kFile);
    for (const char* name : {"parameter", "factor"})
      if (read.column(name) < 0) throw InvalidInput(std::string("it has no column ") + name);
    return read;
  });
  if (!table) return {};
  const auto place = static_cast<std::size_t>(table->column("parameter"));
  std::vector<std::string> names;
  std::map<std::string, statistics::Table> of_parameter;
  for (std::vector<std::string> row : table->rows) {
    const std::string name = row[place];
    statistics::Table& part = of_parameter[name];
    if (part.header.empty())
      names.push_back(name), part.header = table->header,
                             part.header.erase(part.header.begin() + static_cast<std::ptrdiff_t>(place));
    row.erase(row.begin() + static_cast<std::ptrdiff_t>(place));
    part.rows.push_back(std::move(row));
  }
  Json all = Json::array();
  for (const std::string& name : names)
    all.push_back({{"parameter", name}, {"columns", columns(of_parameter[name], kFile, problems)}});
  return all.empty() ? Json() : all;
}

}  // namespace rehearse::report
