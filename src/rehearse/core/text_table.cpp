#include "rehearse/core/text_table.hpp"

#include <algorithm>

namespace rehearse {
namespace {

bool begins_character(char c) { return (c & 0xC0) != 0x80; }

}  // namespace

std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

std::string first_characters(const std::string& text, std::size_t most) {
  std::size_t begun = 0;
  return {text.begin(),
          std::find_if(text.begin(), text.end(), [&](char c) { return begins_character(c) && ++begun > most; })};
}

std::size_t character_at(std::string_view text, std::size_t at) {
  const auto first = static_cast<unsigned char>(text[at]);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  const std::size_t size = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  const std::string_view rest = text.substr(at + 1, size - 1);
  return rest.size() + 1 == size && std::none_of(rest.begin(), rest.end(), begins_character) ? size : 0;
}

std::vector<std::string> aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], characters(row[c]));
  }
  std::vector<std::string> lines;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c)
      line += row[c] + std::string(c + 1 < row.size() ? widths[c] + 2 - characters(row[c]) : 0, ' ');
    lines.push_back(line.substr(0, line.find_last_not_of(' ') + 1));
  }
  return lines;
}

}  // namespace rehearse
