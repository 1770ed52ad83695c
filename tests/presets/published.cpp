#include "published.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rehearse::presets {
namespace {

constexpr const char* kHead = "| option | of | default | published | why |\n|---|---|---|---|---|\n";

template <class Builder>
void add(Builder& builder, bool of_scenarios, std::vector<PublishedOption>& all) {
  const Fields fields = [&](FieldVisitor& v) { builder.fields(v); };
  for (const Field& field : describe_fields(fields)) {
    if (field.published.text.empty()) continue;
    const PublishedOption option{field.name, field.value, field.published, of_scenarios, {}};
    const auto same = std::find_if(all.begin(), all.end(), [&](const PublishedOption& other) {
      return other.key == option.key && other.by_default == option.by_default &&
             other.published.text == option.published.text && other.of_scenarios == of_scenarios;
    });
    PublishedOption& found = same == all.end() ? all.emplace_back(option) : *same;
    found.of.push_back(builder.name());
  }
}

/// The value in TOML.
std::string value_text(const std::string& text) {
  double number = 0;
  return text == "true" || text == "false" || from_text(text, number) ? text : '"' + text + '"';
}

std::string line_of(const PublishedOption& option) {
  const bool in_paper = option.published.source == kPaper;
  return fmt::format("set.{} = {}{}\n", option.key, value_text(option.published.text),
                     in_paper ? "" : " # " + option.published.source);
}

/// Whoever has one of these, whatever the defaults.
std::vector<PublishedOption> without_defaults(const std::vector<PublishedOption>& options) {
  std::vector<PublishedOption> merged;
  for (const PublishedOption& option : options) {
    const auto same = std::find_if(merged.begin(), merged.end(), [&](const PublishedOption& other) {
      return other.key == option.key && other.published.text == option.published.text &&
             other.of_scenarios == option.of_scenarios;
    });
    if (same == merged.end())
      merged.push_back(option);
    else
      same->of.insert(same->of.end(), option.of.begin(), option.of.end());
  }
  return merged;
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream text(row);
  std::string cell;
  std::getline(text, cell, '|');
  while (std::getline(text, cell, '|')) {
    const std::size_t first = cell.find_first_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
  }
  return cells;
}

std::size_t begin_of_table(const std::string& page) {
  const std::size_t head = page.find(kHead);
  if (head == std::string::npos) throw std::runtime_error("the page has no table of deviations");
  return head + std::string(kHead).size();
}

std::size_t end_of_table(const std::string& page) {
  std::size_t end = begin_of_table(page);
  while (end < page.size() && page[end] == '|') end = page.find('\n', end) + 1;
  return end;
}

}  // namespace

std::vector<PublishedOption> published_options(const experiment::Catalogue& catalogue) {
  std::vector<PublishedOption> all;
  for (const auto& builder : catalogue.learner_builders()) add(*builder, false, all);
  for (const auto& builder : catalogue.scenario_builders()) add(*builder, true, all);
  return all;
}

std::string preset_text(const std::vector<PublishedOption>& options) {
  const std::vector<PublishedOption> merged = without_defaults(options);
  std::vector<std::string> heads, parts;
  for (const PublishedOption& option : merged) {
    std::string head = fmt::format("\n[[for]]\n{} = [\"{}\"]\n", option.of_scenarios ? "scenarios" : "learners",
                                   fmt::join(option.of, "\", \""));
    const auto place = std::find(heads.begin(), heads.end(), head) - heads.begin();
    if (static_cast<std::size_t>(place) == heads.size()) {
      heads.push_back(head);
      parts.push_back(std::move(head));
    }
    parts[static_cast<std::size_t>(place)] += line_of(option);
  }
  return fmt::format("{}", fmt::join(parts, ""));
}

std::string Deviation::text() const {
  return fmt::format("| {} | {} | {} | {} | {} |\n", option, of, by_default, published, why);
}

std::vector<Deviation> deviations(const std::vector<PublishedOption>& options) {
  std::vector<Deviation> rows;
  for (const PublishedOption& option : options) {
    if (!option.deviates()) continue;
    const bool in_paper = option.published.source == kPaper;
    rows.push_back({fmt::format("`{}`", option.key), fmt::format("{}", fmt::join(option.of, ", ")), option.by_default,
                    option.published.text + (in_paper ? "" : " (" + option.published.source + ")"), ""});
  }
  return rows;
}

std::vector<Deviation> read_table(const std::string& page) {
  const std::size_t begin = begin_of_table(page);
  std::istringstream table(page.substr(begin, end_of_table(page) - begin));
  std::vector<Deviation> rows;
  for (std::string row; std::getline(table, row);) {
    std::vector<std::string> cells = cells_of(row);
    cells.resize(5);
    rows.push_back({cells[0], cells[1], cells[2], cells[3], cells[4]});
  }
  return rows;
}

std::string with_table(const std::string& page, const std::vector<Deviation>& rows) {
  std::string table;
  for (const Deviation& row : rows) table += row.text();
  return page.substr(0, begin_of_table(page)) + table + page.substr(end_of_table(page));
}

}  // namespace rehearse::presets
