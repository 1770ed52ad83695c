#include "options_page.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/options.hpp"
#include "rehearse/experiment/spec.hpp"

namespace rehearse::presets {
namespace {

constexpr const char* kIntroduction =
    R"(# Options

This page has every option of runs, scenarios and learners.

`--set OPTION=VALUE` sets one, and so do files of presets ([presets.md](presets.md)) and campaigns
([campaigns.md](campaigns.md)). `rehearse list gp-mi` shows those of a learner, `rehearse list pendubot` those of a
scenario, `--expert` more. Units stand in brackets; an option without one is a count, a fraction or a choice. A
published value stands beside a default that is another: it is that of Chatzilygeroudis and Mouret, ICRA 2018, unless
brackets name another source. "The authors' code" is the program that they published with it.

`--set` takes one of the options of runs, `told_by`. `--trials`, `--until-solved`, `--seed` and `--policy` set the
others, which are keys of `spec.toml`.

Robots have more options than these tables: `prior.NAME` is where a parameter of the priors starts, and stays if it is not
tuned; `prior.PRIOR.NAME` is that of one prior alone. The file of a robot of your own also gives `plant.NAME`, and with
[actuators](actuators.md#the-plant) `plant.delay_s.ACTION`. Options of `rehearse identify` are on
[its page](identify.md#options).

Made by `scripts/published` from what the options say of themselves (`fields()`).
)";

/// Options of a learner, a scenario, or of several that have them with the same default.
struct Table {
  std::string title;
  std::vector<Field> fields;
};

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, 1, '\\');
  return text;
}

std::string row(const Field& field) {
  std::string published;
  if (field.deviates())
    published = field.published.text + (field.published.source == kPaper ? "" : " (" + field.published.source + ")");
  const std::string values = field.choices.empty() ? field.bound : fmt::format("{}", fmt::join(field.choices, ", "));
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", field.name, cell(field.value), cell(published), cell(values),
                     cell(field.help));
}

std::string text_of(const std::vector<Table>& tables, bool expert) {
  std::string text;
  for (const auto& [title, fields] : tables) {
    std::string rows;
    for (const Field& field : fields)
      if (field.expert == expert) rows += row(field);
    if (rows.empty()) continue;
    text += fmt::format(
        "\n### {}\n\n| option | default | published | values | what it does |\n|---|---|---|---|---|\n{}", title, rows);
  }
  return text;
}

template <class Builder>
std::vector<Field> fields_of(Builder& builder) {
  return describe_fields([&](FieldVisitor& v) { builder.fields(v); });
}

/// Everything that a row shows.
std::string identity(const Field& field) { return row(field) + (field.expert ? "expert" : ""); }

/// A table for every set of learners that have options in common, in the order of the catalogue.
std::vector<Table> tables_of_learners(const experiment::Catalogue& catalogue) {
  std::map<std::string, std::vector<std::string>> owners;
  for (const auto& builder : catalogue.learner_builders())
    for (const Field& field : fields_of(*builder)) owners[identity(field)].push_back(builder->name());
  std::vector<Table> tables;
  for (const auto& builder : catalogue.learner_builders())
    for (Field& field : fields_of(*builder)) {
      const std::vector<std::string>& names = owners[identity(field)];
      if (names.front() != builder->name()) continue;
      const std::string title = fmt::format("{}", fmt::join(names, ", "));
      auto table = std::find_if(tables.begin(), tables.end(), [&](const Table& t) { return t.title == title; });
      if (table == tables.end()) table = tables.insert(tables.end(), {title, {}});
      table->fields.push_back(std::move(field));
    }
  return tables;
}

std::vector<Table> tables_of_scenarios(const experiment::Catalogue& catalogue) {
  std::vector<Table> tables;
  for (const auto& builder : catalogue.scenario_builders()) tables.push_back({builder->name(), fields_of(*builder)});
  return tables;
}

}  // namespace

std::string options_page(const experiment::Catalogue& catalogue) {
  experiment::Spec spec;
  const std::vector<Table> learners = tables_of_learners(catalogue), scenarios = tables_of_scenarios(catalogue),
                           runs = {{"all", fields_of(spec)}};
  return kIntroduction + ("\n## Runs\n" + text_of(runs, false)) + "\n## Learners\n" + text_of(learners, false) +
         "\n## Scenarios\n" + text_of(scenarios, false) + "\n## Learners, for experts\n" + text_of(learners, true) +
         "\n## Scenarios, for experts\n" + text_of(scenarios, true);
}

}  // namespace rehearse::presets
