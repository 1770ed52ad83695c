#include "rehearse/report/campaign_files.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/report/json_shape.hpp"
#include "rehearse/report/run_files.hpp"
#include "rehearse/statistics/quantiles.hpp"

namespace rehearse::report {
namespace {

namespace fs = std::filesystem;

constexpr Index kFormat = 1;  // of summary.json

/// The keys of docs/campaigns.md that the page and this file need, as check_shape reads them.
constexpr std::string_view kPromised = R"({
  "title": "", "scenario": "", "trials": 0, "seeds": [0], "learners": [""], "priors": [""], "variants": [""],
  "complete": true, "counts": {"runs": 0, "done": 0, "failed": 0},
  "missing": [{"learner": "", "reason": ""}],
  "skipped": [{"path": "", "reason": ""}],
  "runs": [{"run": "", "folder": "", "learner": "", "prior": "", "variant": "", "seed": 0, "state": "", "trials": 0,
            "first_success?": 0, "best_return?": 0, "reason?": ""}],
  "groups": [{"learner": "", "prior": "", "variant": "",
              "trials": [{"trial": 0, "runs": 0, "interaction_s?": 0,
                          "return": {"quartile_1?": 0, "median?": 0, "quartile_3?": 0},
                          "best_return": {"quartile_1?": 0, "median?": 0, "quartile_3?": 0},
                          "solved?": {"runs": 0, "count": 0, "rate?": 0, "low?": 0, "high?": 0},
                          "solved_by?": {"runs": 0, "count": 0, "rate?": 0, "low?": 0, "high?": 0}}]}],
  "claims": [{"text": "", "result": "",
              "parts": [{"learner": "", "priors": [""], "variants": [""], "measure": "", "runs": 0, "of": 0,
                         "against?": {"learner": "", "priors": [""], "variants": [""]}, "count?": 0, "estimate?": 0,
                         "low?": 0, "high?": 0, "required": "", "result": "", "reason?": ""}]}]
})";

using Group = std::tuple<std::string, std::string, std::string>;   // learner, prior, variant
using ByTrial = std::map<Index, std::vector<double>>;              // values of the runs of a group
using Samples = std::map<std::pair<Group, std::string>, ByTrial>;  // by what was measured

Json group_json(const Group& group) {
  return {{"learner", std::get<0>(group)}, {"prior", std::get<1>(group)}, {"variant", std::get<2>(group)}};
}

Json read_summary(const fs::path& path) {
  Json summary = read_json(path);
  if (!summary.is_object() || !summary["format"].is_number_integer())
    throw InvalidInput("it is no summary of a campaign");
  if (summary["format"] != kFormat)
    throw InvalidInput(fmt::format("format {} is that of another version of Rehearse, this one reads {}",
                                   summary["format"].get<Index>(), kFormat));
  check_shape(summary, Json::parse(kPromised));
  return summary;
}

Group group_of(const Json& run) {
  return {run.at("learner").get<std::string>(), run.at("prior").get<std::string>(),
          run.at("variant").get<std::string>()};
}

/// A number of trials, or of one. Throws InvalidInput where no run can have so many.
Index trials_of(double number, const char* what) {
  constexpr double kMost = 1e6;
  if (!(number >= 0 && number <= kMost) || number != std::floor(number))
    throw InvalidInput(fmt::format("{} = {}, must be a whole number in 0 to {}", what, number, kMost));
  return static_cast<Index>(number);
}

/// Adds the values of a column to those of their trials.
void add_by_trial(const files::Table& table, const std::string& column,
                  const std::function<ByTrial&(std::size_t)>& of_row) {
  const auto trials = table.numbers("trial"), values = table.numbers(column);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] && trials[i]) of_row(i)[trials_of(*trials[i], "trial")].push_back(*values[i]);
}

/// Adds a problem for every run that failed, and for what happened to the folders since the summary was written.
void check_runs(const fs::path& folder, const Json& runs, Problems& problems) {
  for (const Json& run : runs) {
    const std::string where = run.at("folder").get<std::string>(), state = run.at("state").get<std::string>();
    const Json reason = run.value("reason", Json());
    if (state == "failed")
      problems.add(where, reason.is_string() ? "failed: " + reason.get<std::string>() : "failed");
    else if (fs::exists(folder / where) || state == "done")
      check_run_folder(folder / where, where, trials_of(run.at("trials").get<double>(), "summary.json: trials"),
                       problems);
  }
}

/// Names entries of runs/ that are no runs of the campaign. Hidden ones are folders that are being made.
void name_strangers(const fs::path& folder, const Json& summary, Problems& problems) {
  std::map<std::string, std::string> reasons;
  for (const Json& skipped : summary.at("skipped"))
    reasons[skipped.at("path").get<std::string>()] = skipped.at("reason").get<std::string>();
  std::set<std::string> known;
  for (const Json& run : summary.at("runs")) known.insert(run.at("folder").get<std::string>());
  std::set<fs::path> entries;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder / "runs", ignored))
    entries.insert("runs" / entry.path().filename());
  for (const fs::path& entry : entries) {
    if (known.contains(entry.string()) || entry.filename().string().starts_with('.')) continue;
    const auto found = reasons.find(entry.string());
    problems.add(entry, found == reasons.end() ? "it is no run of this campaign" : found->second);
  }
}

Samples parameter_samples(const files::Table& table) {
  const auto learners = table.texts("learner"), priors = table.texts("prior"), variants = table.texts("variant");
  Samples samples;
  for (const std::string& name : parameter_names(table))
    add_by_trial(table, "phi." + name, [&](std::size_t i) -> ByTrial& {
      return samples[{{learners[i], priors[i], variants[i]}, name}];
    });
  return samples;
}

Json quartiles_json(const ByTrial& by_trial) {
  Json trials = Json::array();
  for (const auto& [trial, values] : by_trial) {
    const statistics::FiveNumbers five = statistics::five_numbers(values);
    trials.push_back({{"trial", trial},
                      {"runs", values.size()},
                      {"quartile_1", rounded(five.quartile_1)},
                      {"median", rounded(five.median)},
                      {"quartile_3", rounded(five.quartile_3)}});
  }
  return trials;
}

/// One entry a measured thing, in the order of the summary's groups.
Json samples_json(const Json& summary, const Samples& samples, const char* key) {
  Json all = Json::array();
  for (const Json& entry : summary.at("groups"))
    for (const auto& [of, by_trial] : samples) {
      if (of.first != group_of(entry)) continue;
      all.push_back(group_json(of.first));
      all.back()[key] = of.second;
      all.back()["trials"] = quartiles_json(by_trial);
    }
  return all;
}

/// The readable specs of each group.
std::map<Group, std::vector<RunSpec>> specs_of(const fs::path& folder, const Json& runs) {
  std::map<Group, std::vector<RunSpec>> specs;
  for (const Json& run : runs) {
    try {
      specs[group_of(run)].push_back(read_spec(folder / run.at("folder").get<std::string>()));
    } catch (const InvalidInput&) {  // check_runs has named it
    }
  }
  return specs;
}

/// The robot's own value where all these runs have the same: a campaign may draw one for each seed.
std::optional<double> common_truth(const std::vector<RunSpec>& specs, const std::string& name) {
  if (specs.empty()) return std::nullopt;
  const auto truth = specs.front().truth(name);
  const bool same = std::ranges::all_of(specs, [&](const RunSpec& spec) { return spec.truth(name) == truth; });
  return same ? truth : std::nullopt;
}

Json parameters_json(const fs::path& folder, const Json& summary, const files::Table& table) {
  Json parameters = samples_json(summary, parameter_samples(table), "parameter");
  auto specs = specs_of(folder, summary.at("runs"));
  for (Json& parameter : parameters) {
    const auto truth = common_truth(specs[group_of(parameter)], parameter.at("parameter"));
    parameter["truth"] = truth ? rounded(*truth) : Json();
  }
  return parameters;
}

/// Seconds of computing, from the timings of every run that has them.
Samples time_samples(const fs::path& folder, const Json& runs) {
  Samples samples;
  for (const Json& run : runs) {
    try {
      const auto table = read_table(folder / run.at("folder").get<std::string>() / "timings.csv");
      for (const char* part : {"model_s", "search_s"})
        add_by_trial(table, part, [&](std::size_t) -> ByTrial& { return samples[{group_of(run), part}]; });
    } catch (const InvalidInput&) {  // a run that did not start has none
    }
  }
  return samples;
}

}  // namespace

Json read_campaign(const fs::path& folder, Problems& problems) {
  const Json summary = read_summary(folder / "summary.json");
  check_runs(folder, summary.at("runs"), problems);
  name_strangers(folder, summary, problems);
  Json campaign = {{"summary", rounded(summary)}};
  const auto parameters = [&] { return parameters_json(folder, summary, read_table(folder / "campaign.csv")); };
  campaign["parameters"] = problems.value_or_problem("campaign.csv", parameters).value_or(Json::array());
  campaign["times"] = samples_json(summary, time_samples(folder, summary.at("runs")), "part");
  return campaign;
}

}  // namespace rehearse::report
