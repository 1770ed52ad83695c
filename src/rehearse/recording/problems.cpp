#include "rehearse/recording/problems.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::recording {

void Problems::add(Index row, const std::string& kind, const std::string& message) {
  std::vector<Index>& rows = found_.try_emplace(kind, First{row, message, {}}).first->second.rows;
  if (rows.empty() || rows.back() != row) rows.push_back(row);
}

std::vector<std::string> Problems::lines() const {
  std::vector<First> in_order;
  for (const auto& [kind, first] : found_) in_order.push_back(first);
  std::ranges::stable_sort(in_order, {}, &First::row);
  std::vector<std::string> lines;
  for (First& first : in_order) {
    std::ranges::sort(first.rows);
    first.rows.erase(std::unique(first.rows.begin(), first.rows.end()), first.rows.end());
    const std::string where = first.row > 0 ? fmt::format("{}: row {}", source_, first.row) : source_;
    const std::size_t more = first.rows.size() - 1;
    const std::string others = more > 0 ? fmt::format(" (and so in {} more row{})", more, more == 1 ? "" : "s") : "";
    lines.push_back(fmt::format("{}: {}{}", where, first.message, others));
  }
  return lines;
}

void Problems::throw_if_any() const {
  if (!empty()) throw InvalidInput(lines());
}

}  // namespace rehearse::recording
