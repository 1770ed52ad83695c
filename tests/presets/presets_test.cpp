// Holds presets/, the table of deviations and docs/options.md against what the options say of themselves. With
// REHEARSE_UPDATE=1 in the environment (scripts/published) they are made anew; then the table lacks why new rows
// deviate.

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "apps/catalogue.hpp"
#include "options_page.hpp"
#include "published.hpp"
#include "rehearse/experiment/preset_check.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/files/regular_file.hpp"

namespace rehearse::presets {
namespace {

using experiment::Catalogue, experiment::FileOption, experiment::Preset, experiment::Spec;

const std::string kPreset = PROJECT_FOLDER "/presets/as-published.toml";
const std::string kPage = PROJECT_FOLDER "/docs/architecture.md";
const std::string kOptionsPage = PROJECT_FOLDER "/docs/options.md";
const std::string kMadePart = "\n# Made by scripts/published from what the options say of themselves (fields()).\n";
const std::string kHandPart = "\n# By hand: options that depend on the scenario and the learner together.\n";

bool updates() { return std::getenv("REHEARSE_UPDATE") != nullptr; }

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

/// The position after the line that begins a part of the preset.
std::size_t after(const std::string& text, const std::string& mark) {
  const std::size_t found = text.find(mark);
  EXPECT_NE(found, std::string::npos) << mark;
  return found == std::string::npos ? text.size() : found + mark.size();
}

/// Calls `check` with every learner on every scenario.
template <class Check>
void for_all_runs(const Catalogue& catalogue, Check check) {
  for (const auto& scenario : catalogue.scenario_builders())
    for (const auto& learner : catalogue.learner_builders()) {
      const bool can = learner->prior_use() == learners::PriorUse::none || !scenario->prior_names().empty();
      if (can) check(*scenario, *learner, Spec{.scenario = scenario->name(), .learner = learner->name()});
    }
}

std::map<std::string, std::string> by_key(const std::vector<FileOption>& options) {
  std::map<std::string, std::string> texts;
  for (const FileOption& option : options) texts[option.key] = option.text;
  return texts;
}

TEST(AsPublished, IsMadeFromWhatTheOptionsSay) {
  const std::string made = preset_text(published_options(apps::catalogue()));
  std::string text = files::read_file(kPreset);
  const std::size_t begin = after(text, kMadePart), end = text.find(kHandPart);
  ASSERT_NE(end, std::string::npos);
  if (updates()) write(kPreset, text.replace(begin, end - begin, made));
  EXPECT_EQ(files::read_file(kPreset).substr(begin, made.size() + kHandPart.size()), made + kHandPart)
      << "scripts/published makes it anew";
}

/// Also where a scenario's defaults are others than the learner's.
TEST(AsPublished, GivesEachRunWhatIsPublished) {
  const Catalogue catalogue = apps::catalogue();
  const std::string text = files::read_file(kPreset);
  const Preset by_hand("format = 1\n" + text.substr(after(text, kHandPart)), "by hand");
  std::size_t checked = 0;
  for_all_runs(catalogue, [&](auto& scenario, auto& learner, const Spec& spec) {
    std::map<std::string, std::string> got;
    for (const auto& [key, value] : completed(catalogue, with_preset(catalogue, spec, kPreset)).options)
      got[key] = value;
    auto wanted = by_key(by_hand.options(spec.scenario, spec.learner));
    const auto want = [&](const std::string& section, const std::vector<Field>& fields) {
      for (const auto& field : fields)
        if (!field.published.text.empty())
          wanted.emplace(section + field.name, wanted.contains(field.name) ? wanted[field.name] : field.published.text);
    };
    want("learner.", describe_fields([&](FieldVisitor& v) { learner.fields(v); }));
    want("scenario.", describe_fields([&](FieldVisitor& v) { scenario.fields(v); }));
    for (const auto& [key, value] : wanted) {
      if (!key.starts_with("learner.") && !key.starts_with("scenario.")) continue;
      EXPECT_EQ(got[key], value) << key << " of " << spec.learner << " on " << spec.scenario;
      ++checked;
    }
  });
  EXPECT_GT(checked, 300u);
}

TEST(Presets, FitTheRunsThatTheyName) {
  const Catalogue catalogue = apps::catalogue();
  ASSERT_FALSE(catalogue.presets.empty());
  ASSERT_FALSE(catalogue.default_presets.empty());
  std::vector<Preset> all;
  for (const auto& preset : catalogue.presets) all.push_back(find_preset(catalogue, preset.name));
  for (const auto& preset : catalogue.default_presets) all.push_back(*default_preset(catalogue, preset.name));
  for (const Preset& preset : all) {
    std::size_t fitting = 0;
    for_all_runs(catalogue, [&](auto&, auto&, const Spec& spec) {
      if (preset.options(spec.scenario, spec.learner).empty()) return;
      ++fitting;
      for (const std::string& line : violations(preset, catalogue, spec)) ADD_FAILURE() << line;
    });
    EXPECT_GT(fitting, 0u) << preset.source();
  }
}

TEST(Deviations, TableIsMadeFromWhatTheOptionsSay) {
  const std::vector<Deviation> told = read_table(files::read_file(kPage));
  std::vector<Deviation> rows = deviations(published_options(apps::catalogue()));
  for (Deviation& row : rows)
    for (const Deviation& old : told)
      if (old.option == row.option && (row.why.empty() || old.of == row.of)) row.why = old.why;
  if (updates()) write(kPage, with_table(files::read_file(kPage), rows));
  const std::string page = files::read_file(kPage);
  EXPECT_EQ(page, with_table(page, rows)) << "scripts/published makes it anew";
  for (const Deviation& row : rows) EXPECT_FALSE(row.why.empty()) << "docs/architecture.md: why " << row.option << "?";
}

/// The shown ones; every option of `builder` says in a line what it does.
template <class Builder>
Index check_help(Builder& builder) {
  Index shown = 0;
  for (const Field& field : describe_fields([&](FieldVisitor& v) { builder.fields(v); })) {
    EXPECT_FALSE(field.help.empty()) << field.name << " of " << builder.name();
    EXPECT_EQ(field.help.find('\n'), std::string::npos) << field.name;
    EXPECT_LE(field.help.size(), 100u) << field.name << ": " << field.help;
    shown += !field.expert;
  }
  return shown;
}

TEST(Options, SayWhatTheyDoAndFewOfThemMatterToEveryone) {
  const Catalogue catalogue = apps::catalogue();
  for (const auto& scenario : catalogue.scenario_builders()) EXPECT_LE(check_help(*scenario), 20) << scenario->name();
  for (const auto& learner : catalogue.learner_builders()) EXPECT_LE(check_help(*learner), 45) << learner->name();
}

TEST(Options, PageIsMadeFromWhatTheySay) {
  const Catalogue catalogue = apps::catalogue();
  if (!catalogue.not_built.empty()) GTEST_SKIP() << "the page has options of what is not built here";
  if (updates()) write(kOptionsPage, options_page(catalogue));
  EXPECT_EQ(files::read_file(kOptionsPage), options_page(catalogue)) << "scripts/published makes it anew";
}

}  // namespace
}  // namespace rehearse::presets
