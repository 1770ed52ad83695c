#include "rehearse/report/run_files.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "rehearse/core/options.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/files/seal.hpp"
#include "rehearse/files/toml_reader.hpp"
#include "rehearse/report/archive_files.hpp"
#include "rehearse/report/prediction_gap.hpp"
#include "rehearse/report/robustness_files.hpp"

namespace rehearse::report {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kRunFormat = 1;  // of spec.toml

fs::path trial_file(const char* kind, Index trial) { return fs::path(kind) / fmt::format("trial-{:03}.csv", trial); }

/// Under every section but [run].
std::vector<std::pair<std::string, std::string>> options_of(const toml::table& file) {
  std::vector<std::pair<std::string, std::string>> options;
  for (const auto& [name, node] : files::leaves(file))
    if (!name.starts_with("run.") && name.find('.') != std::string::npos)
      options.emplace_back(name, files::text_of(*node));
  return options;
}

void check_checkpoint(const fs::path& path) { files::unseal("checkpoint", read_text(path)); }

void check_ends_with_line(const fs::path& path) {
  const files::RegularFile file(path);
  if (!file.open()) throw InvalidInput(file.problem());
  if (!file.ends_with('\n')) throw InvalidInput("it is cut short");
}

void check_trials(const fs::path& path, Index trials) {
  const auto rows = static_cast<Index>(read_table(path).rows.size());
  if (rows < trials) throw InvalidInput(fmt::format("it has {} of {} trials", rows, trials));
}

Json spec_json(const RunSpec& spec) {
  Json options = Json::array();
  for (const auto& [key, text] : spec.options) options.push_back({key, text});
  return {{"scenario", spec.scenario}, {"learner", spec.learner}, {"prior", spec.prior},
          {"seed", spec.seed},         {"planned", spec.trials},  {"options", options}};
}

Json truths(const RunSpec& spec, const files::Table& trials) {
  Json truth = Json::object();
  for (const std::string& name : parameter_names(trials))
    if (const auto value = spec.truth(name)) truth[name] = rounded(*value);
  return truth;
}

bool all_numbers(const Json& frame) {
  return std::all_of(frame.begin(), frame.end(), [](const Json& x) { return x.is_number() || x.is_null(); });
}

/// Throws InvalidInput unless there are frames of at least so many numbers for each body.
void check_frames(const Json& motion, std::size_t numbers) {
  const Json frames = motion.value("frames", Json());
  const auto is_whole = [&](const Json& frame) {
    return frame.is_array() && frame.size() >= numbers && all_numbers(frame);
  };
  if (!frames.is_array() || frames.empty() || !std::all_of(frames.begin(), frames.end(), is_whole))
    throw InvalidInput(fmt::format("it has no frames of {} numbers each", numbers));
}

/// Numbers of a frame. Throws InvalidInput unless the bodies can be drawn.
std::size_t numbers_of_bodies(const Json& motion) {
  const Json bodies = motion.value("bodies", Json());
  const bool solid = motion.value("dimensions", Json()) == 3;
  const auto can_be_drawn = [&](const Json& body) {
    return body.is_object() && body.value("name", Json()).is_string() &&
           (solid ? body.value("shape", Json()).is_string() : body.value("width", Json()).is_number());
  };
  if (!bodies.is_array() || !std::all_of(bodies.begin(), bodies.end(), can_be_drawn))
    throw InvalidInput("its bodies cannot be drawn");
  return bodies.size() * (solid ? 7 : 4);
}

/// The bodies are its own, unless it is a prediction for those of another one.
Json read_motion(const fs::path& path, const Json& bodies_of) {
  Json motion = rounded(read_json(path));
  if (!motion.is_object()) throw InvalidInput("it is no motion");
  check_frames(motion, numbers_of_bodies(bodies_of.is_object() ? bodies_of : motion));
  return motion;
}

/// The motion of a trial, from its files; null if the scenario cannot draw its robot.
Json motion(const fs::path& folder, Index trial, Problems& problems) {
  const auto read = [&](const char* kind, const Json& bodies_of) -> Json {
    const fs::path path = fs::path("motion") / fmt::format("{}-{:03}.json", kind, trial);
    if (!fs::exists(folder / path)) return {};
    return problems.value_or_problem(path, [&] { return read_motion(folder / path, bodies_of); }).value_or(Json());
  };
  Json motion = read("trial", {});
  if (!motion.is_object()) return motion;
  const Json prediction = read("prediction", motion);
  if (prediction.is_object()) motion["predicted"] = prediction["frames"];
  return motion;
}

Index trajectories_in(const fs::path& folder) {
  Index trials = 0;
  while (fs::exists(folder / trial_file("trajectories", trials + 1))) ++trials;
  return trials;
}

Json episode(const fs::path& folder, Index trial, Problems& problems) {
  const auto table = [&](const fs::path& path) {
    return problems.value_or_problem(path, [&] { return columns(read_table(folder / path), path, problems); })
        .value_or(Json());
  };
  const fs::path prediction = trial_file("predictions", trial);
  Json predicted, gap;
  const auto read_prediction = [&] {
    const files::Table read = read_table(folder / prediction);
    predicted = columns(read, prediction, problems);
    gap = prediction_gap(read);
    return true;
  };
  if (fs::exists(folder / prediction))
    problems.value_or_problem(prediction, read_prediction);  // a random trial has none
  return {{"trial", trial},
          {"trajectory", table(trial_file("trajectories", trial))},
          {"prediction", std::move(predicted)},
          {"gap", std::move(gap)},
          {"motion", motion(folder, trial, problems)}};
}

/// The limits of the run; null for a task without limits.
Json limits_json(const fs::path& folder, Problems& problems) {
  const fs::path path = "limits.csv";
  if (!fs::exists(folder / path)) return {};
  const auto table = problems.value_or_problem(path, [&] { return read_table(folder / path); });
  if (!table) return {};
  Json numbers = columns(*table, path, problems, "limit");
  Json names = numbers.value("limit", Json::array());
  numbers.erase("limit");
  return {{"names", std::move(names)}, {"numbers", std::move(numbers)}};
}

}  // namespace

std::optional<double> RunSpec::truth(const std::string& name) const {
  const std::string key = "scenario.plant." + name.substr(0, name.find('@'));
  for (const auto& [option, text] : options) {
    double value = 0;
    if (option == key && from_text(text, value)) return value;
  }
  return std::nullopt;
}

RunSpec read_spec(const fs::path& folder) {
  const toml::table file = files::parse_toml(read_text(folder / "spec.toml"), "");
  const std::int64_t format = file["format"].value_or(std::int64_t{0});
  if (format == 0 || !file["run"].is_table()) throw InvalidInput("it is no spec: it needs `format` and [run]");
  if (format != kRunFormat)
    throw InvalidInput(
        fmt::format("format {} is that of another version of Rehearse, this one reads {}", format, kRunFormat));
  const auto run = file["run"];
  return {.scenario = run["scenario"].value_or(std::string{}),
          .learner = run["learner"].value_or(std::string{}),
          .prior = run["prior"].value_or(std::string{}),
          .trials = run["trials"].value_or(Index{0}),
          .seed = run["seed"].value_or(Index{0}),
          .options = options_of(file)};
}

std::vector<std::string> parameter_names(const files::Table& trials) {
  constexpr std::string_view kPrefix = "phi.";
  const std::set<std::string> columns(trials.header.begin(), trials.header.end());
  const auto is_end = [&](const std::string& column) {  // of the interval of a parameter
    return (column.ends_with(".low") || column.ends_with(".high")) &&
           columns.contains(column.substr(0, column.rfind('.')));
  };
  std::vector<std::string> names;
  for (const std::string& column : trials.header)
    if (column.starts_with(kPrefix) && !is_end(column)) names.push_back(column.substr(kPrefix.size()));
  return names;
}

void check_run_folder(const fs::path& folder, const fs::path& where, Index trials, Problems& problems) {
  const auto check = [&](const fs::path& file, auto reader) {
    problems.value_or_problem(where / file, [&] { return reader(), true; });
  };
  if (!fs::is_directory(folder)) return problems.add(where, "it is not there, or no folder");
  check("spec.toml", [&] { read_spec(folder); });
  check("checkpoint", [&] { check_checkpoint(folder / "checkpoint"); });
  check("trials.csv", [&] { check_trials(folder / "trials.csv", trials); });
  for (const char* table : {"elites.csv", "tried.csv"})  // not every learner has them
    if (fs::exists(folder / table)) check(table, [&] { check_ends_with_line(folder / table); });
  for (Index trial = 1; trial <= trials; ++trial) {
    const fs::path trajectory = trial_file("trajectories", trial), prediction = trial_file("predictions", trial);
    check(trajectory, [&] { check_ends_with_line(folder / trajectory); });
    if (!fs::exists(folder / trajectory)) break;  // one line tells as much as one for each trial
    if (fs::exists(folder / prediction)) check(prediction, [&] { check_ends_with_line(folder / prediction); });
  }
}

Json read_run(const fs::path& folder, std::optional<Index> only, const Knowledge& knowledge, Problems& problems) {
  const RunSpec spec = read_spec(folder);
  Json run = spec_json(spec);
  if (knowledge.robot) {
    const RobotFacts facts = knowledge.robot(spec.scenario);
    run["task"] = facts.task;
    run["units"] = facts.units;
  }
  run["done"] = fs::exists(folder / "done");
  if (fs::exists(folder / "failed"))
    if (const auto why = problems.value_or_problem("failed", [&] { return read_text(folder / "failed"); }))
      problems.add("failed", why->substr(0, why->find_last_not_of('\n') + 1));
  if (fs::exists(folder / "logs.csv")) run["logs"] = true;  // told before trial 1, whose model has learned from them
  Index trials = trajectories_in(folder);
  if (const auto table = problems.value_or_problem("trials.csv", [&] { return read_table(folder / "trials.csv"); })) {
    trials = static_cast<Index>(table->rows.size());
    run["trials"] = columns(*table, "trials.csv", problems);
    run["truth"] = truths(spec, *table);
  }
  const std::string none;
  std::vector<std::pair<std::string, std::string>> tables{{"timings", none}, {"errors", none}, {"notes", "note"}};
  if (fs::exists(folder / "identifiability.csv"))
    tables.emplace_back("identifiability", "warning");  // not in the folders of older versions
  for (const auto& [name, of_texts] : tables) {
    const fs::path path = name + ".csv";
    if (const auto table = problems.value_or_problem(path, [&] { return read_table(folder / path); }))
      run[name] = columns(*table, path, problems, of_texts);
  }
  if (Json limits = limits_json(folder, problems); !limits.is_null()) run["limits"] = std::move(limits);
  problems.value_or_problem("checkpoint", [&] { return check_checkpoint(folder / "checkpoint"), true; });
  if (!only) {
    Json archive = archive_json(folder, knowledge.archive, problems);
    if (!archive.is_null()) run["archive"] = std::move(archive);
    Json robustness = robustness_json(folder, problems);
    if (!robustness.is_null()) run["robustness"] = std::move(robustness);
  }
  run["episodes"] = Json::array();
  for (Index trial = only.value_or(1); trial <= only.value_or(trials); ++trial)
    run["episodes"].push_back(episode(folder, trial, problems));
  return run;
}

}  // namespace rehearse::report
