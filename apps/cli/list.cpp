#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "apps/cli/commands.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/experiment/preset.hpp"
#include "rehearse/experiment/spec.hpp"

namespace rehearse::apps {
namespace {

using Json = nlohmann::ordered_json;

template <class Builder>
std::vector<std::pair<std::string, std::string>> options_of(Builder& builder) {
  return list_fields([&](FieldVisitor& v) { builder.fields(v); });
}

/// By name, where it is another than the default.
template <class Builder>
std::map<std::string, Published> published_otherwise(Builder& builder) {
  std::map<std::string, Published> all;
  for (const auto& [name, published] : list_published([&](FieldVisitor& v) { builder.fields(v); }))
    all.emplace(name, published);
  for (const auto& [name, text] : options_of(builder))
    if (const auto found = all.find(name); found != all.end() && found->second.text == text) all.erase(found);
  return all;
}

template <class Builder>
Json described(Builder& builder) {
  Json options = Json::object(), published = Json::object();
  for (const auto& [name, text] : options_of(builder)) options[name] = text;
  for (const auto& [name, known] : published_otherwise(builder))
    published[name] = {{"value", known.text}, {"source", known.source}};
  return {{"name", builder.name()}, {"summary", builder.summary()}, {"options", options}, {"published", published}};
}

Json as_json(const experiment::Catalogue& catalogue) {
  Json all = {{"scenarios", Json::array()},
              {"learners", Json::array()},
              {"presets", Json::array()},
              {"not_built", Json::array()}};
  for (const auto& builder : catalogue.scenario_builders()) {
    all["scenarios"].push_back(described(*builder));
    all["scenarios"].back()["priors"] = builder->prior_names();
  }
  for (const auto& builder : catalogue.learner_builders()) {
    all["learners"].push_back(described(*builder));
    all["learners"].back()["takes_prior"] = builder->prior_use() != learners::PriorUse::none;
    all["learners"].back()["chooses_priors"] = builder->chooses_priors();
  }
  for (const auto& preset : catalogue.presets)
    all["presets"].push_back({{"name", preset.name}, {"title", experiment::Preset(preset.text, preset.name).title()}});
  for (const auto& missing : catalogue.not_built)
    all["not_built"].push_back({{"name", missing.name}, {"reason", missing.reason}});
  return all;
}

template <class Builder>
void print_entry(Builder& builder, const std::string& remark, bool with_options) {
  fmt::print("  {:<18} {}\n", builder.name(), builder.summary());
  fmt::print("  {:<18} {}\n", "", remark);
  if (!with_options) return;
  const auto otherwise = published_otherwise(builder);
  for (const auto& [name, text] : options_of(builder)) {
    const auto found = otherwise.find(name);
    const std::string remark =
        found == otherwise.end() ? "" : fmt::format("  ({}: {})", found->second.source, found->second.text);
    fmt::print("  {:<18}   {} = {}{}\n", "", name, text, remark);
  }
}

std::string prior_remark(const learners::LearnerBuilder& builder) {
  if (builder.prior_use() == learners::PriorUse::none) return "takes no prior";
  return builder.chooses_priors() ? "takes a prior, or several to choose among: --prior a,b,c" : "takes a prior";
}

std::string prior_remark(const scenario::ScenarioBuilder& builder) {
  const char* oracle = builder.build().oracle ? "; or oracle, the plant's own dynamics" : "";
  return fmt::format("priors: {}{}", fmt::join(builder.prior_names(), ", "), oracle);
}

/// Of any scenario with any learner.
void print_run_options() {
  experiment::Spec spec;
  fmt::print("\nRuns\n");
  for (const auto& [name, text] : list_fields([&](FieldVisitor& v) { spec.settable_fields(v); }))
    fmt::print("  {:<18}   {} = {}\n", "", name, text);
}

void print(const experiment::Catalogue& catalogue, bool with_options) {
  fmt::print("Scenarios\n");
  for (const auto& builder : catalogue.scenario_builders()) print_entry(*builder, prior_remark(*builder), with_options);
  fmt::print("\nLearners\n");
  for (const auto& builder : catalogue.learner_builders()) print_entry(*builder, prior_remark(*builder), with_options);
  if (!catalogue.presets.empty()) fmt::print("\nPresets\n");
  for (const auto& preset : catalogue.presets)
    fmt::print("  {:<18} {}\n", preset.name, experiment::Preset(preset.text, preset.name).title());
  if (with_options) print_run_options();
  if (!catalogue.not_built.empty()) fmt::print("\nNot built\n");
  for (const auto& missing : catalogue.not_built) fmt::print("  {:<18} {}\n", missing.name, missing.reason);
  if (!with_options) fmt::print("\nOptions for --set, with their defaults: rehearse list --options\n");
}

}  // namespace

int list(const experiment::Catalogue& catalogue, const ListArguments& arguments) {
  if (arguments.json)
    fmt::print("{}\n", as_json(catalogue).dump(2));
  else
    print(catalogue, arguments.options);
  return kSuccess;
}

}  // namespace rehearse::apps
