#include "rehearse/files/table.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/options.hpp"

namespace rehearse::files {
namespace {

/// Takes rows from the front of a text.
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  bool at_end() const { return rest_.empty(); }
  int rows_read() const { return row_; }

  std::vector<std::string> row() {
    ++row_;
    std::vector<std::string> cells;
    do cells.push_back(rest_.starts_with('"') ? quoted() : bare());
    while (take(','));
    if (rest_.starts_with("\r\n")) rest_.remove_prefix(1);
    if (!take('\n')) throw InvalidInput(fmt::format("row {} is cut short", row_));
    return cells;
  }

 private:
  bool take(char c) {
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  std::string bare() {
    const std::string_view cell = rest_.substr(0, rest_.find_first_of(",\r\n"));
    rest_.remove_prefix(cell.size());
    return std::string(cell);
  }

  std::string quoted() {
    take('"');
    for (std::string cell;; cell += '"') {  // two of them stand for one
      const std::string_view part = rest_.substr(0, rest_.find('"'));
      rest_.remove_prefix(part.size());
      cell += part;
      if (!take('"')) throw InvalidInput(fmt::format("row {} is cut short", row_));
      if (!take('"')) return cell;
    }
  }

  std::string_view rest_;
  int row_ = 0;
};

std::optional<double> number(const std::string& cell, std::string_view column) {
  if (cell.empty()) return std::nullopt;
  double value = 0;
  if (!from_text(cell, value)) throw InvalidInput(fmt::format("column {}: '{}' is no number", column, cell));
  return value;
}

}  // namespace

int Table::column(std::string_view name) const {
  const auto found = std::find(header.begin(), header.end(), name);
  return found == header.end() ? -1 : static_cast<int>(found - header.begin());
}

std::vector<std::string> Table::texts(std::string_view name) const {
  const int position = column(name);
  if (position < 0) throw InvalidInput(fmt::format("there is no column {}", name));
  std::vector<std::string> cells;
  for (const auto& row : rows) cells.push_back(row[static_cast<std::size_t>(position)]);
  return cells;
}

std::vector<std::optional<double>> Table::numbers(std::string_view name) const {
  std::vector<std::optional<double>> values;
  for (const std::string& cell : texts(name)) values.push_back(number(cell, name));
  return values;
}

Table read_csv(std::string_view text) {
  Reader reader(text);
  if (reader.at_end()) throw InvalidInput("the table is empty");
  Table table{.header = reader.row()};
  while (!reader.at_end()) {
    table.rows.push_back(reader.row());
    const std::size_t cells = table.rows.back().size(), columns = table.header.size();
    if (cells != columns)
      throw InvalidInput(fmt::format("row {} has {} cells, the header has {}{}", reader.rows_read(), cells, columns,
                                     cells > columns ? ": decimals need a point, columns a comma" : ""));
  }
  return table;
}

}  // namespace rehearse::files
