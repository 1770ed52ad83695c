#include "apps/cli/options_table.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "rehearse/core/text_table.hpp"

namespace rehearse::apps {
namespace {

constexpr std::size_t kColumns = 5, kGap = 2, kWidestCell = 18, kNarrowestHelp = 32;
using Row = std::array<std::string, kColumns>;
using Widths = std::array<std::size_t, kColumns>;

/// Lines of at most so many characters, unless a word has more.
std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.back().empty() && characters(lines.back()) + 1 + characters(word) > width) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  return lines;
}

Row row_of(const Field& field) {
  std::string published;
  if (field.deviates())
    published = field.published.text + (field.published.source == kPaper ? "" : " (" + field.published.source + ")");
  const std::string values = field.choices.empty() ? field.bound : fmt::format("{}", fmt::join(field.choices, ", "));
  return {field.name, field.value.empty() ? "\"\"" : field.value, published, values, field.help};
}

Widths widths_of(const std::vector<Row>& rows, std::size_t width) {
  Widths widths{};
  for (const Row& row : rows)
    for (std::size_t c = 0; c < kColumns; ++c)
      for (const std::string& line : c == 0 ? std::vector{row[c]} : wrapped(row[c], kWidestCell))
        widths[c] = std::max(widths[c], characters(line));
  std::size_t before = 0;
  for (std::size_t c = 0; c + 1 < kColumns; ++c) before += widths[c] + kGap;
  widths.back() = std::max(width, before + kNarrowestHelp) - before;
  return widths;
}

std::string text_of(const Row& row, const Widths& widths) {
  std::array<std::vector<std::string>, kColumns> cells;
  std::size_t height = 1;
  for (std::size_t c = 0; c < kColumns; ++c) {
    cells[c] = wrapped(row[c], widths[c]);
    height = std::max(height, cells[c].size());
  }
  std::string text;
  for (std::size_t i = 0; i < height; ++i) {
    std::string line;
    for (std::size_t c = 0; c < kColumns; ++c) {
      const std::string cell = i < cells[c].size() ? cells[c][i] : "";
      line += cell + std::string(widths[c] + kGap - std::min(widths[c], characters(cell)), ' ');
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return text;
}

}  // namespace

std::size_t terminal_width() {
  constexpr std::size_t kNone = 120, kWidest = 160;
  winsize size{};
  if (::isatty(STDOUT_FILENO) == 0 || ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kNone;
  return std::min<std::size_t>(size.ws_col, kWidest);
}

std::string options_table(const std::vector<Field>& fields, std::size_t width) {
  const bool any_deviates = std::any_of(fields.begin(), fields.end(), [](const Field& f) { return f.deviates(); });
  std::vector<Row> rows = {{"OPTION", "DEFAULT", any_deviates ? "PUBLISHED" : "", "VALUES", "WHAT IT DOES"}};
  for (const Field& field : fields) rows.push_back(row_of(field));
  const Widths widths = widths_of(rows, width);
  std::string text;
  for (const Row& row : rows) text += text_of(row, widths);
  return text;
}

}  // namespace rehearse::apps
