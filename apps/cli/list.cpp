#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "apps/catalogue.hpp"
#include "apps/cli/arguments.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/complain.hpp"
#include "apps/cli/options_table.hpp"
#include "apps/cli/program.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/core/text_table.hpp"
#include "rehearse/experiment/preset.hpp"
#include "rehearse/experiment/spec.hpp"
#include "rehearse/experiment/study_setup.hpp"

namespace rehearse::apps {
namespace {

using Json = nlohmann::ordered_json;

/// The command `identify`, whose options are listed as those of a learner.
struct IdentifyEntry {
  experiment::IdentifyOptions options;
  static std::string name() { return "identify"; }
  static std::string summary() { return "a robot's parameters, and what no parameter explains, from logs"; }
  void fields(FieldVisitor& v) { options.fields(v); }
};

/// Options that every run has, whatever its scenario and learner.
struct RunEntry {
  experiment::Spec spec;
  static std::string name() { return "run"; }
  static std::string summary() { return "what every run has, whatever its scenario and learner"; }
  void fields(FieldVisitor& v) { spec.settable_fields(v); }
};

template <class Builder>
std::vector<Field> options_of(Builder& builder) {
  return describe_fields([&](FieldVisitor& v) { builder.fields(v); });
}

Json described(const Field& field) {
  return {{"name", field.name},    {"value", field.value},     {"help", field.help},
          {"bounds", field.bound}, {"choices", field.choices}, {"expert", field.expert}};
}

template <class Builder>
Json described(Builder& builder) {
  Json options = Json::object(), published = Json::object(), fields = Json::array();
  for (const Field& field : options_of(builder)) {
    options[field.name] = field.value;
    if (field.deviates()) published[field.name] = {{"value", field.published.text}, {"source", field.published.source}};
    fields.push_back(described(field));
  }
  return {{"name", builder.name()},
          {"summary", builder.summary()},
          {"options", options},
          {"published", published},
          {"fields", fields}};
}

Json as_json(scenario::ScenarioBuilder& builder) {
  Json entry = described(builder);
  entry["priors"] = builder.prior_names();
  entry["oracle"] = static_cast<bool>(builder.build().oracle);
  return entry;
}

Json as_json(learners::LearnerBuilder& builder) {
  Json entry = described(builder);
  entry["takes_prior"] = builder.prior_use() != learners::PriorUse::none;
  entry["chooses_priors"] = builder.chooses_priors();
  entry["scenario_defaults"] = Json::object();
  for (const auto& [name, text] : builder.scenario_defaults()) entry["scenario_defaults"][name] = text;
  return entry;
}

Json as_json(IdentifyEntry& entry) { return described(entry); }

Json as_json(const experiment::Catalogue& catalogue) {
  RunEntry run;
  Json all = {{"run", described(run)},
              {"scenarios", Json::array()},
              {"learners", Json::array()},
              {"presets", Json::array()},
              {"not_built", Json::array()}};
  for (const auto& builder : catalogue.scenario_builders()) all["scenarios"].push_back(as_json(*builder));
  for (const auto& builder : catalogue.learner_builders()) all["learners"].push_back(as_json(*builder));
  for (const auto& preset : catalogue.presets)
    all["presets"].push_back({{"name", preset.name}, {"title", experiment::Preset(preset.text, preset.name).title()}});
  for (const auto& missing : catalogue.not_built)
    all["not_built"].push_back({{"name", missing.name}, {"reason", missing.reason}});
  return all;
}

template <class Builder>
void print_entry(Builder& builder, const std::string& remark, bool with_options) {
  put("  {:<18} {}\n", builder.name(), builder.summary());
  put("  {:<18} {}\n", "", remark);
  if (!with_options) return;
  for (const Field& field : options_of(builder)) {
    const std::string otherwise =
        field.deviates() ? fmt::format("  ({}: {})", field.published.source, field.published.text) : "";
    put("  {:<18}   {} = {}{}\n", "", field.name, field.value, otherwise);
  }
}

std::string remark_of(const learners::LearnerBuilder& builder) {
  std::string remark = builder.prior_use() == learners::PriorUse::none ? "takes no prior" : "takes a prior";
  if (builder.chooses_priors()) remark += ", or several to choose among: --prior a,b,c";
  for (const auto& [name, text] : builder.scenario_defaults())
    remark += fmt::format("; {} = {}, unless another is set", name, text);
  return remark;
}

std::string remark_of(const scenario::ScenarioBuilder& builder) {
  const char* oracle = builder.build().oracle ? "; or oracle, the plant's own dynamics" : "";
  return fmt::format("priors: {}{}", fmt::join(builder.prior_names(), ", "), oracle);
}

void print_run_options() {
  RunEntry run;
  put("\nRuns\n");
  for (const Field& field : options_of(run)) put("  {:<18}   {} = {}\n", "", field.name, field.value);
}

void print(const experiment::Catalogue& catalogue, bool with_options) {
  put("Scenarios\n");
  for (const auto& builder : catalogue.scenario_builders()) print_entry(*builder, remark_of(*builder), with_options);
  put("\nLearners\n");
  for (const auto& builder : catalogue.learner_builders()) print_entry(*builder, remark_of(*builder), with_options);
  if (!catalogue.presets.empty()) put("\nPresets\n");
  for (const auto& preset : catalogue.presets)
    put("  {:<18} {}\n", preset.name, experiment::Preset(preset.text, preset.name).title());
  if (with_options) print_run_options();
  if (!catalogue.not_built.empty()) put("\nNot built\n");
  for (const auto& missing : catalogue.not_built) put("  {:<18} {}\n", missing.name, missing.reason);
  if (!with_options) put("\nOptions for --set, with what they do: {} list NAME\n", program_name());
}

std::string remark_of(const IdentifyEntry& /*entry*/) { return "takes a prior, and options of the robot beside these"; }

std::string parameter_text(const Parameter& parameter) {
  if (parameter.kind == Parameter::Kind::continuous)
    return fmt::format("{:.6g}, {:.6g} to {:.6g}", parameter.value, parameter.box.low, parameter.box.high);
  if (parameter.kind == Parameter::Kind::discrete)
    return fmt::format("{:.6g}, of {}", parameter.value, fmt::join(parameter.choices, " "));
  return fmt::format("{:.6g}, fixed", parameter.value);
}

/// The parameters of each prior, a row a name: the value that learning starts from, and its bounds.
void print_parameters(scenario::ScenarioBuilder& builder) {
  std::vector<std::vector<std::string>> rows{{"PARAMETER"}};
  const std::vector<scenario::NamedPrior> priors = builder.build().priors;
  for (const scenario::NamedPrior& prior : priors) {
    rows.front().push_back(prior.name);
    for (const Parameter& parameter : prior.parameters.all()) {
      const std::string label = with_unit("prior." + parameter.name, parameter.unit);
      auto row = std::ranges::find(rows, label, [](const auto& each) { return each.front(); });
      if (row == rows.end()) row = rows.insert(row, {label});
      row->resize(rows.front().size());
      row->back() = parameter_text(parameter);
    }
  }
  if (rows.size() == 1) return;
  put("\nWhere the parameters of priors start; prior.PRIOR.NAME is that of one prior alone\n");
  for (const std::string& line : aligned(rows)) put("{}\n", line);
}

template <class Other>
void print_parameters(Other& /*has none*/) {}

/// Prints the options for everyone; those for experts on request, else their number.
template <class Builder>
void print_one(Builder& builder, const std::string& kind, const std::string& name, bool with_expert) {
  put("{} {}: {}\n{:{}} {}\n", kind, builder.name(), builder.summary(), "", kind.size() + builder.name().size() + 2,
      remark_of(builder));
  std::vector<Field> shown = options_of(builder);
  const auto middle = std::stable_partition(shown.begin(), shown.end(), [](const Field& f) { return !f.expert; });
  const std::vector<Field> hidden(middle, shown.end());
  shown.erase(middle, shown.end());
  if (!shown.empty()) put("\n{}", options_table(shown, terminal_width()));
  print_parameters(builder);
  if (hidden.empty()) return;
  if (with_expert)
    put("\nFor experts\n{}", options_table(hidden, terminal_width()));
  else
    put("\n{} more for experts: {} list {} --expert\n", hidden.size(), program_name(), name);
}

[[noreturn]] void refuse(const experiment::Catalogue& catalogue, const std::string& name) {
  if (catalogue.left_out(name)) throw InvalidInput(catalogue.why_missing("scenario", name));
  std::vector<std::string> known;
  for (const auto& builder : catalogue.scenario_builders()) known.push_back(builder->name());
  for (const auto& builder : catalogue.learner_builders()) known.push_back(builder->name());
  known.push_back(IdentifyEntry::name());
  throw InvalidInput(experiment::unknown_name("scenario or learner", name, known));
}

/// Calls visit(entry, kind) with the learner, command or scenario of this name, or the robot of this file.
template <class Visit>
void visit_entry(const experiment::Catalogue& built_in, const std::string& name, Visit visit) {
  if (const auto learner = built_in.learner(name)) return visit(*learner, "learner");
  if (IdentifyEntry entry; name == entry.name()) return visit(entry, "command");
  const experiment::Catalogue catalogue = with_robot(built_in, name);
  const auto scenario = catalogue.scenario(catalogue.scenario_name(name));
  if (!scenario) refuse(catalogue, name);
  visit(*scenario, "scenario");
}

}  // namespace

std::string entry_json(const experiment::Catalogue& catalogue, const std::string& name) {
  std::string text;
  visit_entry(catalogue, name, [&](auto& entry, const char* /*kind*/) { text = as_json(entry).dump(2); });
  return text;
}

int list(const experiment::Catalogue& catalogue, const ListArguments& arguments) {
  if (arguments.schema && (arguments.name || arguments.json || arguments.options || arguments.expert))
    throw InvalidInput("--schema is of all robots' files, so it stands alone");
  if (arguments.name && arguments.json) {
    fmt::print("{}\n", entry_json(catalogue, *arguments.name));
  } else if (arguments.name) {
    visit_entry(catalogue, *arguments.name, [&](auto& entry, const char* kind) {
      print_one(entry, kind, *arguments.name, arguments.expert || arguments.options);
    });
  } else if (arguments.expert) {
    throw InvalidInput(fmt::format("--expert is for one scenario or learner: {} list NAME --expert", program_name()));
  } else if (arguments.schema)
    fmt::print("{}", robot_schema());
  else if (arguments.json)
    fmt::print("{}\n", as_json(catalogue).dump(2));
  else
    print(catalogue, arguments.options);
  return kSuccess;
}

}  // namespace rehearse::apps
