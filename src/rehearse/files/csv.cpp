#include "rehearse/files/csv.hpp"

#include <cmath>

#include "rehearse/core/options.hpp"

namespace rehearse::files {
namespace {

std::string escaped(const std::string& cell) {
  if (cell.find_first_of(",\"\n\r") == std::string::npos) return cell;
  std::string out = "\"";
  for (char c : cell) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

}  // namespace

void Csv::row(const std::vector<std::string>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) text_ += ',';
    text_ += escaped(cells[i]);
  }
  text_ += '\n';
}

std::string Csv::cell(Index value) { return std::to_string(value); }
std::string Csv::cell(double value) { return std::isnan(value) ? std::string{} : to_text(value); }

}  // namespace rehearse::files
