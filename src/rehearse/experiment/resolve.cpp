#include "rehearse/experiment/resolve.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/experiment/preset.hpp"
#include "rehearse/experiment/priors.hpp"
#include "rehearse/files/toml_reader.hpp"

namespace rehearse::experiment {
namespace {

constexpr std::string_view kScenario = "scenario.", kLearner = "learner.", kPrior = "prior.";

/// The options of a scenario or a learner; one that is unknown has none.
template <class Builder>
Fields options_of(const std::unique_ptr<Builder>& builder) {
  return [&builder](FieldVisitor& v) {
    if (builder) builder->fields(v);
  };
}

/// The checks beside those of names and of each value alone.
struct Check {
  bool learner = true;     // whether it can do with the task and the policy
  bool conditions = true;  // between the spec's own options
};

/// Resolves one spec, collecting what is wrong with it as far as it can be known.
class Resolver {
 public:
  Resolver(const Catalogue& catalogue, const Spec& spec, Check check)
      : catalogue_(catalogue),
        spec_(spec),
        check_(check),
        scenario_builder_(catalogue.scenario(spec.scenario)),
        learner_builder_(catalogue.learner(spec.learner)),
        default_preset_(default_preset(catalogue, spec.scenario)) {
    violations_.add(field_violations([this](FieldVisitor& v) { spec_.fields(v); }));
    if (!scenario_builder_) violations_.add(catalogue.why_missing("scenario", spec.scenario));
    if (!learner_builder_) violations_.add(catalogue.why_missing("learner", spec.learner));
    check_robot(catalogue.robot(spec.scenario));
    if (scenario_builder_ && learner_builder_) return;
    check_the_known_one();
    violations_.throw_if_any();
  }

  /// settings: set after the spec's own options.
  Resolved resolve(const learners::OptionTexts& settings = {}) {
    set_preferences();
    if (default_preset_) set_defaults(*default_preset_);
    for (const auto& [key, text] : spec_.options) set_option(key, text);
    const std::vector<std::string> allowed = check_.conditions ? std::vector<std::string>{} : broken_conditions();
    for (const auto& [key, text] : settings) set_option(key, text);
    spec_.options.insert(spec_.options.end(), settings.begin(), settings.end());
    check_conditions(allowed);
    const std::vector<std::string> names = prior_names();
    const auto scenario = contained([&] { return scenario_builder_->build(); });
    if (!scenario) violations_.throw_if_any();
    violations_.add(scenario->task.violations());
    violations_.require(!spec_.until_solved || scenario->task.solved,
                        fmt::format("until_solved: {} cannot say what is solved", spec_.scenario));
    violations_.require(scenario->policy != nullptr, fmt::format("scenario {} has no policy", spec_.scenario));
    if (check_.learner && scenario->policy)
      for (const std::string& line : learner_builder_->violations(scenario->task, *scenario->policy))
        violations_.add(line);
    if (!spec_.start.empty() && scenario->policy) check_start(*scenario->policy);
    ChosenPriors priors(*scenario, names, violations_);
    set_prior_values(priors);
    auto prior = contained([&] { return priors.prior(); });
    violations_.throw_if_any();
    complete(names, priors);
    std::vector<std::string> warnings = warnings_of(*scenario, names, *prior);
    return {spec_,
            *scenario,
            std::move(*prior),
            std::move(learner_builder_),
            std::move(comments_),
            std::move(robot_),
            std::move(warnings)};
  }

 private:
  /// Where scenario or learner is unknown: the values of the other one's options, and the names of priors.
  void check_the_known_one() {
    for (const auto& [key, text] : spec_.options) contained([&] { return set_named(key, text); });
    check_conditions({});
    if (!scenario_builder_) return;
    if (const auto scenario = contained([&] { return scenario_builder_->build(); }))
      ChosenPriors(*scenario, split_names(spec_.prior), violations_);
  }

  std::vector<std::string> broken_conditions() const {
    std::vector<std::string> all = field_violations(options_of(scenario_builder_));
    for (const std::string& line : field_violations(options_of(learner_builder_))) all.push_back(line);
    return all;
  }

  void check_conditions(const std::vector<std::string>& allowed) {
    for (const std::string& line : broken_conditions())
      if (!is_among(line, allowed)) violations_.add(line);
  }

  void check_robot(const RobotFile* file) {
    const std::string checksum = file ? checksum_of(*file) : "";
    if (!spec_.robot.empty() && spec_.robot != checksum)
      violations_.add(file ? fmt::format("{} has another robot than this run began with", file->source)
                           : fmt::format("the file of the robot '{}' is missing", spec_.scenario));
    spec_.robot = checksum;
    comments_["robot"] = "checksum of robot.toml, the file that describes the robot, and of the files that it names";
    if (file) robot_ = *file;
  }

  void check_start(const policy::Policy& policy) {
    const std::optional<Vector> theta = start_of(spec_.start);
    violations_.require(learner_builder_->takes_start(), catalogue_.why_no_start(learner_builder_->name()));
    violations_.require(
        theta && theta->size() == policy.parameters(),
        fmt::format("start must be the {} numbers of the policy '{}'", policy.parameters(), policy.name()));
  }

  /// The result of `make`; none, and a violation, if its input is invalid.
  template <class Make>
  auto contained(Make make) -> std::optional<decltype(make())> {
    try {
      return make();
    } catch (const InvalidInput& error) {
      violations_.add(error.what());
      return std::nullopt;
    }
  }

  /// Returns false if there is no such option. Throws InvalidInput.
  bool set_named(std::string_view key, const std::string& text) {
    const Fields scenario = options_of(scenario_builder_), learner = options_of(learner_builder_);
    return set_field(scenario, key, text) || set_field(learner, key, text) ||
           (key.starts_with(kScenario) && set_field(scenario, key.substr(kScenario.size()), text)) ||
           (key.starts_with(kLearner) && set_field(learner, key.substr(kLearner.size()), text));
  }

  void set_option(const std::string& key, const std::string& text) {
    const Fields of_run = [this](FieldVisitor& v) { spec_.settable_fields(v); };
    const bool known = contained([&] { return set_named(key, text) || set_field(of_run, key, text); }).value_or(true);
    if (!known && !key.starts_with(kPrior))  // these wait until the scenario is built
      violations_.add(why_unknown(key));
  }

  /// Sets the options that the learner prefers, as far as the scenario has them and no robot's file sets them.
  void set_preferences() {
    for (const auto& [key, text] : learner_builder_->scenario_defaults()) {
      if (is_among(key, scenario_builder_->stated())) continue;
      try {
        set_field(options_of(scenario_builder_), key, text);
      } catch (const InvalidInput&) {  // no such value: as if nothing were preferred
      }
    }
  }

  void set_defaults(const Preset& preset) {
    for (const FileOption& option : preset.options(spec_.scenario, spec_.learner)) {
      try {
        if (!set_named(option.key, option.text)) throw InvalidInput(why_unknown(option.key));
      } catch (const InvalidInput& error) {
        violations_.add(files::in_file(preset.source(), option.line, error.what()));
      }
    }
  }

  std::string why_unknown(const std::string& key) const {
    const std::vector<std::string> known = options_like(key);
    const auto of_plant = [](const std::string& name) {
      return name.starts_with("plant.") || name.starts_with("scenario.plant.");
    };
    if (of_plant(key) && std::none_of(known.begin(), known.end(), of_plant))
      return fmt::format("unknown option '{}': the plant of {} has no parameters that are options", key,
                         spec_.scenario);
    return unknown_option(key, known);
  }

  /// The options that a key may mean, written like the key: with its prefix if it has one, then of that section alone.
  std::vector<std::string> options_like(std::string_view key) const {
    std::vector<std::string> known;
    const auto add = [&](std::string_view section, const auto& fields) {
      for (const auto& [name, text] : fields) known.push_back(std::string(section) + name);
    };
    const bool of_learner = key.starts_with(kLearner), of_scenario = key.starts_with(kScenario);
    if (!of_learner) add(of_scenario ? kScenario : "", list_fields(options_of(scenario_builder_)));
    if (!of_scenario) add(of_learner ? kLearner : "", list_fields(options_of(learner_builder_)));
    Spec of_run = spec_;
    if (!of_learner && !of_scenario) add("", list_fields([&](FieldVisitor& v) { of_run.settable_fields(v); }));
    return known;
  }

  std::vector<std::string> prior_names() {
    const std::vector<std::string> named = split_names(spec_.prior);
    const std::string learner = learner_builder_->name();
    if (learner_builder_->prior_use() == learners::PriorUse::none) {
      violations_.require(named.empty(),
                          fmt::format("learner {} takes no prior, but '{}' is given", learner, spec_.prior));
      return {};
    }
    violations_.require(
        named.size() < 2 || learner_builder_->chooses_priors(),
        fmt::format("learner {} takes one prior, but '{}' names {}", learner, spec_.prior, named.size()));
    if (!named.empty()) return named;
    const std::vector<std::string> known = scenario_builder_->prior_names();
    violations_.require(!known.empty(), fmt::format("learner {} needs a prior, but scenario {} has none", learner,
                                                    scenario_builder_->name()));
    return known.empty() ? known : std::vector{known.front()};
  }

  void set_prior_values(ChosenPriors& priors) {
    for (const auto& [key, text] : spec_.options) {
      if (!key.starts_with(kPrior) || is_field(key)) continue;
      if (learner_builder_->prior_use() == learners::PriorUse::none)
        violations_.add(fmt::format("{} = {}, but learner {} takes no prior", key, text, learner_builder_->name()));
      else
        priors.set(key.substr(kPrior.size()), text, violations_);
    }
  }

  bool is_field(const std::string& key) const { return is_among(key, options_like(key)); }

  std::vector<std::string> warnings_of(const scenario::Scenario& scenario, const std::vector<std::string>& names,
                                       const std::optional<prior::Prior>& prior) const {
    std::vector<std::string> warnings;
    const bool oracle = is_among(scenario::kOracle, names);
    if (learner_builder_->tunes_prior() && prior && !oracle && !prior->space.has_tunable())
      warnings.push_back(fmt::format("prior {} has nothing to tune, so {} learns no parameters", spec_.prior,
                                     learner_builder_->name()));
    if (oracle)
      for (const std::string& line : scenario.oracle_lacks)
        warnings.push_back("the oracle is not all of the plant: " + line);
    for (const std::string& line : learner_builder_->warnings(scenario.task))
      warnings.push_back(fmt::format("{}: {}", learner_builder_->name(), line));
    return warnings;
  }

  void complete(const std::vector<std::string>& names, const ChosenPriors& priors) {
    spec_.prior.clear();
    for (const std::string& name : names) spec_.prior += (spec_.prior.empty() ? "" : ",") + name;
    spec_.options.clear();
    add_options(kScenario, describe_fields(options_of(scenario_builder_)));
    add_options(kLearner, describe_fields(options_of(learner_builder_)));
    for (const auto& [name, text] : priors.values()) {
      spec_.options.emplace_back(name, text);
      comments_[name] = "the prior's, before anything is learned";
    }
    for (const Field& field : describe_fields([this](FieldVisitor& v) { spec_.fields(v); }))
      comments_[field.name] = field.help;
  }

  void add_options(std::string_view section, const std::vector<Field>& fields) {
    for (const Field& field : fields) {
      const std::string key = std::string(section) + field.name;
      spec_.options.emplace_back(key, field.value);
      comments_[key] = field.help;
    }
  }

  const Catalogue& catalogue_;
  Spec spec_;
  Check check_;
  Comments comments_;
  std::optional<RobotFile> robot_;
  Violations violations_;
  std::unique_ptr<scenario::ScenarioBuilder> scenario_builder_;
  std::unique_ptr<learners::LearnerBuilder> learner_builder_;
  std::optional<Preset> default_preset_;
};

}  // namespace

const prior::Prior* Resolved::stand_in() const {
  return !scenario.make_plant && prior && split_names(spec.prior).size() == 1 ? &*prior : nullptr;
}

Resolved resolve(const Catalogue& catalogue, const Spec& spec) { return Resolver(catalogue, spec, {}).resolve(); }

Resolved resolve_begun(const Catalogue& catalogue, const Spec& spec, const learners::OptionTexts& settings) {
  return Resolver(catalogue, spec, {.conditions = false}).resolve(settings);
}

Spec completed(const Catalogue& catalogue, const Spec& spec) {
  return Resolver(catalogue, spec, {.learner = false}).resolve().spec;
}

std::string default_learner(const Catalogue& catalogue, const Spec& spec) {
  const auto robot = catalogue.scenario(spec.scenario);  // of an unknown one resolving it complains
  const bool guessed = !robot || !robot->prior_names().empty() || !spec.prior.empty();
  return guessed ? "gp-mi" : "black-drops";
}

}  // namespace rehearse::experiment
