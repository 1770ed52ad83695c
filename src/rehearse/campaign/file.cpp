#include "rehearse/campaign/file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "rehearse/campaign/seeds.hpp"
#include "rehearse/files/toml_reader.hpp"

namespace rehearse::campaign {
namespace {

constexpr Index kFormat = 1;

class CampaignReader {
 public:
  CampaignReader(const toml::table& table, files::FileViolations& violations)
      : table_(table), violations_(violations), reader_(table, "", violations) {}

  CampaignFile read() {
    check_format();
    read_grid();
    read_options();
    read_axes();
    each_table("variant", [this](const toml::table& table) { read_variant(table); });
    read_draws();
    each_table("claim", [this](const toml::table& table) { read_claim(table); });
    reader_.finish();
    for (const auto& [key, node] : table_) file_.lines[std::string(key.str())] = files::line_of(node);
    return std::move(file_);
  }

 private:
  void check_format() {
    const toml::node* format = reader_.take("format");
    if (!format)
      violations_.add(0, fmt::format("format is missing; write format = {}", kFormat));
    else if (format->value_exact<std::int64_t>() != kFormat)
      reader_.wrong("format", fmt::format("this version of Rehearse reads format = {}", kFormat));
  }

  void read_grid() {
    reader_.take("title", file_.title);
    if (!reader_.take("scenario", file_.scenario) || table_["scenario"].value<std::string>() == "")
      violations_.add(0, "scenario is missing");
    reader_.take("preset", file_.preset);
    if (!reader_.take("learners", file_.learners)) violations_.add(0, "learners is missing");
    reader_.take("priors", file_.priors);
    reader_.take_fields([&](FieldVisitor& v) {
      v.integer("trials", file_.trials, "how often a run may use the plant", between(1, 1e6));
      v.boolean("until_solved", file_.until_solved, "end before, with a trial that solves the task");
    });
    read_seeds();
  }

  void read_seeds() {
    const toml::node* seeds = reader_.take("seeds");
    if (!seeds) return violations_.add(0, "seeds is missing; write for instance seeds = \"1-30\"");
    try {
      file_.seeds = seeds_of(*seeds);
    } catch (const InvalidInput& error) {
      reader_.wrong("seeds", error.what());
    }
  }

  std::vector<experiment::FileOption> options_of(const toml::table& table) {
    std::vector<experiment::FileOption> options;
    for (const auto& [key, node] : files::leaves(table)) {
      if (node->is_array())
        violations_.add(files::line_of(*node), fmt::format("{}: one value; several go into [vary]", key));
      else if (const auto text = files::text_of(key, *node, violations_))
        options.push_back({key, *text, files::line_of(*node)});
    }
    return options;
  }

  void read_options() {
    if (const toml::table* set = reader_.take_table("set")) file_.options = options_of(*set);
    const toml::table* learners = reader_.take_table("learner");
    if (!learners) return;
    for (const auto& [key, node] : *learners) {
      const std::string name(key.str());
      file_.lines["learner." + name] = files::line_of(node);
      if (const auto* options = node.as_table())
        file_.learner_options[name] = options_of(*options);
      else
        violations_.add(files::line_of(node),
                        fmt::format("learner.{} must be a table [learner.NAME] of options", name));
    }
  }

  void read_axes() {
    const toml::table* vary = reader_.take_table("vary");
    if (!vary) return;
    for (const auto& [key, node] : files::leaves(*vary)) {
      Axis axis{.key = key, .line = files::line_of(*node)};
      if (const auto* list = node->as_array())
        for (const toml::node& element : *list)
          if (const auto text = files::text_of(key, element, violations_)) axis.texts.push_back(*text);
      const std::vector<std::string>& texts = axis.texts;
      for (const std::string& text : texts)
        if (std::count(texts.begin(), texts.end(), text) > 1)
          violations_.add(axis.line, fmt::format("{} has the value {} twice", key, text));
      if (texts.empty()) violations_.add(axis.line, fmt::format("{} must be a list of values in [vary]", key));
      file_.axes.push_back(std::move(axis));
    }
  }

  /// Every [[key]].
  template <class Read>
  void each_table(const std::string& key, Read read) {
    const toml::node* tables = reader_.take(key);
    if (!tables) return;
    if (!tables->is_array_of_tables()) return reader_.wrong(key, fmt::format("{0}s are written as [[{0}]]", key));
    for (const toml::node& table : *tables->as_array()) read(*table.as_table());
  }

  void read_variant(const toml::table& table) {
    files::TomlReader reader(table, "[[variant]]", violations_);
    Variant variant{.line = files::line_of(table)};
    reader.take("name", variant.name);
    if (variant.name.empty()) violations_.add(variant.line, "the variant has no name");
    const bool plain = std::all_of(variant.name.begin(), variant.name.end(), [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || std::string_view("._+-").find(c) != std::string_view::npos;
    });
    if (!plain)
      violations_.add(variant.line, fmt::format("the variant's name '{}' must be of letters, digits and . _ + - alone",
                                                variant.name));
    for (const Variant& other : file_.variants)
      if (other.name == variant.name)
        violations_.add(variant.line, fmt::format("there are two variants '{}'", variant.name));
    reader.take("preset", variant.preset);
    if (const toml::table* set = reader.take_table("set")) variant.options = options_of(*set);
    reader.finish();
    file_.variants.push_back(std::move(variant));
  }

  void read_draws() {
    const toml::table* draws = reader_.take_table("draw");
    if (!draws) return;
    for (const auto& [key, node] : files::leaves(*draws)) {
      std::vector<double> ends;
      if (const auto* list = node->as_array())
        for (const toml::node& element : *list) ends.push_back(element.value<double>().value_or(std::nan("")));
      const bool ok = ends.size() == 2 && std::isfinite(ends[0]) && std::isfinite(ends[1]) && ends[0] < ends[1];
      if (ok)
        file_.draws.push_back({key, ends[0], ends[1], files::line_of(*node)});
      else
        violations_.add(files::line_of(*node), fmt::format("{} must be [LOW, HIGH] in [draw], LOW below HIGH", key));
    }
  }

  void read_claim(const toml::table& table) {
    files::TomlReader reader(table, "[[claim]]", violations_);
    Claim claim{.line = files::line_of(table)};
    if (!reader.take("text", claim.text)) violations_.add(claim.line, "the claim has no text");
    if (!reader.take("learner", claim.learner) || claim.learner.empty())
      violations_.add(claim.line, "the claim names no learner");
    reader.take("priors", claim.priors);
    reader.take("variants", claim.variants);
    reader.take_fields([&](FieldVisitor& v) {
      v.boolean("pooled", claim.pooled, "of all priors together");
      v.boolean("observed", claim.observed, "judged by the estimate alone, not by its interval");
    });
    read_kind(reader, claim);
    reader.finish();
    file_.claims.push_back(std::move(claim));
  }

  void read_kind(files::TomlReader& reader, Claim& claim) {
    const bool success = reader.has("solved_by") || reader.has("reached_by"), better = reader.has("better_than"),
               not_worse = reader.has("not_worse_than"),
               median = reader.has("median_at_least") || reader.has("median_at_most");
    if (success + better + not_worse + median != 1)
      violations_.add(claim.line,
                      "a claim has one of solved_by, reached_by, better_than, not_worse_than, and median_at_least or "
                      "median_at_most");
    if (success) claim.success = read_success(reader);
    if (better || not_worse) claim.comparison = read_comparison(reader, better ? "better_than" : "not_worse_than");
    if (median) claim.median = read_median(reader);
  }

  Bound trials() const { return between(1, static_cast<double>(file_.trials)); }

  std::optional<double> number(files::TomlReader& reader, const std::string& key, Bound bound = {}) {
    double value = 0;
    const bool there = reader.has(key);
    reader.take_fields([&](FieldVisitor& v) { v.number(key, value, "number of a claim", bound); });
    return there ? std::optional(value) : std::nullopt;
  }

  std::optional<Index> count(files::TomlReader& reader, const std::string& key) {
    Index value = 0;
    const bool there = reader.has(key);
    reader.take_fields([&](FieldVisitor& v) { v.integer(key, value, "number of runs", at_least(0)); });
    return there ? std::optional(value) : std::nullopt;
  }

  SuccessClaim read_success(files::TomlReader& reader) {
    SuccessClaim success;
    const bool reached = reader.has("reached_by");
    reader.take_fields([&](FieldVisitor& v) {
      v.integer(reached ? "reached_by" : "solved_by", success.measure.trial, "trial, from 1", trials());
    });
    if (reached) success.measure.success_return = number(reader, "return_at_least");
    if (reached && !success.measure.success_return) violations_.add(reader.line(), "reached_by needs return_at_least");
    success.at_least_rate = number(reader, "at_least_rate", between(0, 1));
    success.at_most_rate = number(reader, "at_most_rate", between(0, 1));
    success.at_least_runs = count(reader, "at_least_runs");
    success.at_most_runs = count(reader, "at_most_runs");
    if (!success.at_least_rate && !success.at_most_rate && !success.at_least_runs && !success.at_most_runs)
      violations_.add(reader.line(), "how many? at_least_runs, at_most_runs, at_least_rate or at_most_rate");
    if (success.at_least_runs && success.at_most_runs && *success.at_most_runs < *success.at_least_runs)
      violations_.add(reader.line(), fmt::format("at_most_runs = {}, must be ≥ at_least_runs = {}",
                                                 *success.at_most_runs, *success.at_least_runs));
    if (success.at_least_rate && success.at_most_rate && *success.at_most_rate < *success.at_least_rate)
      violations_.add(reader.line(), fmt::format("at_most_rate = {}, must be ≥ at_least_rate = {}",
                                                 *success.at_most_rate, *success.at_least_rate));
    return success;
  }

  Measure read_measure(files::TomlReader& reader) {
    Measure measure{.trial = file_.trials};
    if (!reader.has("metric"))
      violations_.add(reader.line(), "metric is missing: \"return\", \"best_return\" or \"first_success\"");
    reader.take_fields([&](FieldVisitor& v) {
      v.choice("metric", measure.metric, "what is compared", {"return", "best_return", "first_success"});
      v.integer("trial", measure.trial, "after which trial, from 1", trials());
    });
    return measure;
  }

  ComparisonClaim read_comparison(files::TomlReader& reader, const std::string& key) {
    ComparisonClaim comparison{.measure = read_measure(reader)};
    if (key == "not_worse_than") comparison.not_worse_by = number(reader, "margin", at_least(0)).value_or(0);
    const toml::table* other = reader.take_table(key);
    if (!other) return comparison;
    files::TomlReader inner(*other, key, violations_);
    const auto name = [&](const char* what) {
      std::string text;
      return inner.take(what, text) ? std::optional(text) : std::nullopt;
    };
    comparison.learner = name("learner");
    comparison.prior = name("prior");
    comparison.variant = name("variant");
    inner.finish();
    if (other->empty()) reader.wrong(key, fmt::format("{} names nothing: learner, prior or variant", key));
    return comparison;
  }

  MedianClaim read_median(files::TomlReader& reader) {
    MedianClaim median{.measure = read_measure(reader)};
    median.at_least = number(reader, "median_at_least");
    median.at_most = number(reader, "median_at_most");
    if (median.at_least && median.at_most && *median.at_most < *median.at_least)
      violations_.add(reader.line(), fmt::format("median_at_most = {}, must be ≥ median_at_least = {}", *median.at_most,
                                                 *median.at_least));
    return median;
  }

  const toml::table& table_;
  files::FileViolations& violations_;
  files::TomlReader reader_;
  CampaignFile file_;
};

}  // namespace

CampaignFile read_campaign_file(std::string_view text, const std::string& source, files::FileViolations& violations) {
  const toml::table table = files::parse_toml(text, source);
  CampaignFile file = CampaignReader(table, violations).read();
  if (file.title.empty()) file.title = std::filesystem::path(source).stem().string();
  return file;
}

}  // namespace rehearse::campaign
