#include "rehearse/campaign/planner.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/campaign/claim_plan.hpp"
#include "rehearse/campaign/draws.hpp"
#include "rehearse/campaign/overlaps.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/experiment/location.hpp"
#include "rehearse/experiment/preset_check.hpp"
#include "rehearse/experiment/priors.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/files/toml_reader.hpp"

namespace rehearse::campaign {
namespace {

constexpr std::size_t kMostRuns = 100000;
constexpr std::size_t kLongestFolderName = 240;  // bytes; file systems take 255

using FileOptions = std::vector<experiment::FileOption>;

/// The options that the runs of a group have from [[variant]] and [vary].
struct Varied {
  std::string name;
  FileOptions options;
  std::string preset = {};  // of the variant in line `line`
  Index line = 0;

  void add(const experiment::FileOption& option) {
    name += fmt::format("{}{}={}", name.empty() ? "" : ",", option.key, option.text);
    options.push_back(option);
  }
};

class Planner {
 public:
  Planner(const experiment::Catalogue& catalogue, const CampaignFile& file, files::FileViolations& violations)
      : catalogue_(catalogue), file_(file), violations_(violations) {
    plan_.title = file.title;
    plan_.scenario = file.scenario;
    plan_.trials = file.trials;
    plan_.until_solved = file.until_solved;
    plan_.seeds = file.seeds;
  }

  CampaignPlan plan() {
    const bool scenario = catalogue_.scenario(file_.scenario) != nullptr;
    if (!scenario && !file_.scenario.empty())
      violations_.add(line("scenario"), catalogue_.why_missing("scenario", file_.scenario));
    for (const std::string& learner : file_.learners) add_learner(learner, scenario);
    for (const auto& [learner, options] : file_.learner_options) check_is_planned(learner);
    if (!known_options_.empty()) check_all_used();
    for (const Claim& claim : file_.claims) check_learners(claim);
    if (!violations_.empty()) return {};
    for (const Claim& claim : file_.claims) plan_.claims.push_back(plan_claim(plan_, claim, violations_));
    return std::move(plan_);
  }

 private:
  Index line(const std::string& key) const {
    const auto found = file_.lines.find(key);
    return found == file_.lines.end() ? 0 : found->second;
  }

  void add_learner(const std::string& name, bool scenario) {
    const auto builder = catalogue_.learner(name);
    if (!builder) {
      const std::string why = catalogue_.why_missing("learner", name);
      if (catalogue_.left_out(name))
        plan_.missing.push_back({name, why});
      else
        violations_.add(line("learners"), why);
      return;
    }
    const bool no_prior = builder->prior_use() == learners::PriorUse::none || file_.priors.empty();
    if (scenario)
      for (const std::string& prior : no_prior ? std::vector<std::string>{""} : file_.priors) add_cell(name, prior);
  }

  /// All variants and seeds of one learner and prior.
  void add_cell(const std::string& learner, const std::string& prior) {
    const experiment::Spec bare = {.scenario = file_.scenario,
                                   .learner = learner,
                                   .prior = prior,
                                   .trials = file_.trials,
                                   .until_solved = file_.until_solved,
                                   .seed = file_.seeds.empty() ? 1 : file_.seeds.front()};
    const auto complete = value_or_violations(line(prior.empty() ? "learners" : "priors"),
                                              [&] { return experiment::completed(catalogue_, bare); });
    if (!complete) return;
    for (const auto& [key, text] : complete->options)
      known_options_.push_back(key.starts_with("prior.") ? key : key.substr(key.find('.') + 1));
    for (const auto& [at, message] : overlaps(*complete, file_)) violations_.add(at, message);
    for (const std::string& name : experiment::options_of_runs()) known_options_.push_back(name);
    const FileOptions options = common_options(*complete);
    const std::vector<Varied> variants = all_variants(*complete);
    if (plan_.runs.size() + variants.size() * file_.seeds.size() > kMostRuns) return too_many();
    for (const Varied& varied : variants) {
      auto begun = begun_with(file_.preset, bare, line("preset"));
      if (begun) begun = begun_with(varied.preset, *begun, varied.line);
      if (begun) add_group(*begun, options, draws_of(*complete), varied);
    }
  }

  /// The value that the work returns, or nothing and the violations that it throws, at this line.
  template <class Work>
  auto value_or_violations(Index line, Work work) -> std::optional<decltype(work())> {
    try {
      return work();
    } catch (const InvalidInput& error) {
      for (const std::string& message : error.violations()) violations_.add(line, message);
      return std::nullopt;
    }
  }

  /// The spec with the options of this preset, if there is one, or nothing and violations, at this line.
  std::optional<experiment::Spec> begun_with(const std::string& preset, const experiment::Spec& spec, Index line) {
    if (preset.empty()) return spec;
    return value_or_violations(line, [&] { return with_preset(catalogue_, spec, preset); });
  }

  /// The complete spec, or nothing and violations, at the line of the option that causes each.
  std::optional<experiment::Spec> resolved(const experiment::Spec& bare, const FileOptions& options) {
    try {
      experiment::Resolved run = experiment::resolve(catalogue_, experiment::with_options(bare, options));
      if (run.scenario.make_plant) return std::move(run.spec);
      violations_.add(line("scenario"),
                      fmt::format("{} has no plant, which runs need (in a file [plant])", bare.scenario));
      return std::nullopt;
    } catch (const InvalidInput& error) {
      for (const std::string& message : error.violations())
        violations_.add(line_of_cause(bare, options, message), message);
      return std::nullopt;
    }
  }

  /// The line of `learners` if the bare spec is just as wrong; else that of an option that alone is the cause, or 0.
  Index line_of_cause(const experiment::Spec& bare, const FileOptions& options, const std::string& message) const {
    if (experiment::has_violation(catalogue_, bare, message)) return line("learners");
    const experiment::FileOption* option = experiment::cause(catalogue_, bare, options, message);
    return option ? option->line : 0;
  }

  /// The options of [set] that this cell has, and all of [learner.NAME].
  FileOptions common_options(const experiment::Spec& complete) {
    FileOptions options;
    for (const experiment::FileOption& option : file_.options)
      if (use(complete, option.key)) options.push_back(option);
    const auto own = file_.learner_options.find(complete.learner);
    if (own != file_.learner_options.end()) options.insert(options.end(), own->second.begin(), own->second.end());
    return options;
  }

  std::vector<Draw> draws_of(const experiment::Spec& complete) {
    std::vector<Draw> draws;
    for (const Draw& draw : file_.draws)
      if (use(complete, draw.key)) draws.push_back(draw);
    return draws;
  }

  /// The variants of [[variant]] all of whose options this cell has; one without a name if there are none.
  std::vector<Varied> named_variants(const experiment::Spec& complete) {
    std::vector<Varied> found;
    for (const Variant& variant : file_.variants) {
      bool has_all = true;
      for (const experiment::FileOption& option : variant.options) has_all &= use(complete, option.key);
      if (has_all) found.push_back({variant.name, variant.options, variant.preset, variant.line});
    }
    if (found.empty()) found.emplace_back();
    return found;
  }

  /// Every combination of these and of what this cell has of [vary], the last fastest.
  std::vector<Varied> all_variants(const experiment::Spec& complete) {
    std::vector<Axis> axes;
    for (const Axis& axis : file_.axes)
      if (use(complete, axis.key) && !axis.texts.empty()) axes.push_back(axis);
    std::vector<Varied> variants = named_variants(complete);
    for (const Axis& axis : axes) {
      if (variants.size() * axis.texts.size() > kMostRuns) {
        too_many();
        return {};
      }
      std::vector<Varied> longer;
      for (const Varied& variant : variants)
        for (const std::string& text : axis.texts) {
          longer.push_back(variant);
          longer.back().add({axis.key, text, axis.line});
        }
      variants = std::move(longer);
    }
    return variants;
  }

  void too_many() { violations_.add(0, fmt::format("these are more than {} runs", kMostRuns)); }

  bool use(const experiment::Spec& complete, const std::string& key) {
    const bool has = !reached_options(complete, key).empty();
    if (has) used_.insert(key);
    return has;
  }

  void add_group(const experiment::Spec& bare, FileOptions options, const std::vector<Draw>& draws,
                 const Varied& varied) {
    options.insert(options.end(), varied.options.begin(), varied.options.end());
    auto complete = resolved(bare, options);
    if (!complete) return;
    plan_.groups.push_back({bare.learner, complete->prior, varied.name, {}});
    if (!varied.preset.empty()) plan_.groups.back().options.emplace_back("preset", varied.preset);
    for (const experiment::FileOption& option : varied.options)
      plan_.groups.back().options.emplace_back(option.key, option.text);
    for (Index seed : file_.seeds) {
      if (!draws.empty()) complete = resolved(bare, with_draws(options, draws, seed));
      if (!complete) return;
      experiment::Spec spec = *complete;
      spec.seed = seed;
      std::string name = experiment::run_name(spec, varied.name);
      if (!check_name(name)) return;
      plan_.runs.push_back({std::move(name), plan_.groups.size() - 1, std::move(spec)});
    }
  }

  /// The first bad one is named, and none where something else may be why.
  bool check_name(const std::string& name) {
    if (!violations_.empty()) return false;
    if (name.size() > kLongestFolderName)
      violations_.add(0,
                      fmt::format("the name of a run's folder is longer than {} bytes: {}; [[variant]] gives options "
                                  "that go together a short name",
                                  kLongestFolderName, name));
    else if (!names_.insert(name).second)
      violations_.add(0, fmt::format("two runs would have the folder {}: they are the same but for what no name of a "
                                     "folder can tell",
                                     name));
    else
      return true;
    return false;
  }

  static FileOptions with_draws(FileOptions options, const std::vector<Draw>& draws, Index seed) {
    for (const Draw& draw : draws) options.push_back(drawn(draw, seed));
    return options;
  }

  void check_learners(const Claim& claim) {
    for (const std::string& name : {claim.learner, claim.comparison ? claim.comparison->learner.value_or("") : ""})
      if (!name.empty() && !is_among(name, file_.learners))
        violations_.add(claim.line, fmt::format("the claim's learner '{}' is none of the learners ({})", name,
                                                fmt::join(file_.learners, ", ")));
  }

  void check_is_planned(const std::string& learner) {
    if (is_among(learner, file_.learners)) return;
    violations_.add(line("learner." + learner),
                    fmt::format("[learner.{}] is none of the learners ({})", learner, fmt::join(file_.learners, ", ")));
  }

  void check_all_used() {
    for (const experiment::FileOption& option : file_.options) check_used(option.key, option.line);
    for (const Axis& axis : file_.axes) check_used(axis.key, axis.line);
    for (const Draw& draw : file_.draws) check_used(draw.key, draw.line);
    for (const Variant& variant : file_.variants)
      for (const experiment::FileOption& option : variant.options) check_used(option.key, option.line);
  }

  void check_used(const std::string& key, Index line) {
    if (!used_.contains(key) && !is_among(key, known_options_))
      violations_.add(line, experiment::unknown_option(key, known_options_));
  }

  const experiment::Catalogue& catalogue_;
  const CampaignFile& file_;
  files::FileViolations& violations_;
  CampaignPlan plan_;
  std::set<std::string> used_;
  std::set<std::string> names_;  // of the runs' folders
  std::vector<std::string> known_options_;
};

}  // namespace

CampaignPlan plan_campaign(const experiment::Catalogue& catalogue, std::string_view text, const std::string& source) {
  files::FileViolations violations(source);
  CampaignFile file = read_campaign_file(text, source, violations);
  file.scenario = catalogue.scenario_name(file.scenario);
  CampaignPlan plan = Planner(catalogue, file, violations).plan();
  violations.throw_if_any();
  return plan;
}

}  // namespace rehearse::campaign
