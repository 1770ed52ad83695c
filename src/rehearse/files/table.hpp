#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rehearse::files {

/// Comma-separated text: a header, and rows of as many cells.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;

  /// Position of a column, or −1.
  int column(std::string_view name) const;

  /// The cells of a column. Throws InvalidInput if there is no such column.
  std::vector<std::string> texts(std::string_view name) const;

  /// A column as numbers; an empty cell has none. Throws InvalidInput if there is no such column, or a cell that is
  /// neither empty nor a number.
  std::vector<std::optional<double>> numbers(std::string_view name) const;
};

/// Reads RFC 4180. Throws InvalidInput with the row (the header is 1) if one has too few or too many cells, a quotation
/// does not end, or the last row has no end: then the text was cut short.
Table read_csv(std::string_view text);

}  // namespace rehearse::files
