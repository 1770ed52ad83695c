// A robot from logs alone.
#include <filesystem>

#include <fmt/format.h>

#include "apps/cli/arguments.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/complain.hpp"
#include "apps/cli/signals.hpp"
#include "apps/cli/status_line.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/experiment/priors.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/files/write.hpp"
#include "rehearse/recording/recording.hpp"
#include "rehearse/study/page.hpp"
#include "rehearse/study/study.hpp"
#include "rehearse/study/summary.hpp"
#include "rehearse/study/tables.hpp"

namespace rehearse::apps {
namespace {

namespace fs = std::filesystem;

struct IdentifyOptions {
  study::Options study;
  recording::ReadOptions read{.average = true};
  void fields(FieldVisitor& v) {
    study.fields(v);
    v.group("read", read);
  }
};

/// A robot with a prior, and how it is learned.
struct Setup {
  scenario::Scenario scenario;
  std::optional<prior::Prior> prior;
  IdentifyOptions options;
};

bool set_one(const Fields& fields, const std::string& key, const std::string& text, Violations& violations) {
  try {
    return set_field(fields, key, text);
  } catch (const InvalidInput& error) {
    violations.add(error.what());
    return true;
  }
}

std::vector<std::string> known_keys(const Fields& a, const Fields& b) {
  std::vector<std::string> keys;
  for (const Fields* fields : {&a, &b})
    for (const auto& [name, value] : list_fields(*fields)) keys.push_back(name);
  return keys;
}

Setup set_up(const experiment::Catalogue& catalogue, const IdentifyArguments& arguments, Violations& violations) {
  const std::string name = catalogue.scenario_name(arguments.robot);
  const auto builder = catalogue.scenario(name);
  if (!builder) throw InvalidInput(catalogue.why_missing("scenario", name));
  Setup setup;
  const Fields own = [&](FieldVisitor& v) { setup.options.fields(v); };
  const Fields of_robot = [&](FieldVisitor& v) { builder->fields(v); };
  std::vector<std::pair<std::string, std::string>> of_prior;
  for (const auto& [key, text] : settings_of(arguments.set, violations)) {
    if (key.starts_with("prior."))
      of_prior.emplace_back(key.substr(6), text);
    else if (!set_one(own, key, text, violations) && !set_one(of_robot, key, text, violations))
      violations.add(experiment::unknown_option(key, known_keys(own, of_robot)));
  }
  violations.throw_if_any();
  setup.scenario = builder->build();
  std::vector<std::string> names = experiment::split_names(arguments.prior.value_or(""));
  if (names.empty() && !setup.scenario.priors.empty()) names = {setup.scenario.priors.front().name};
  if (names.empty()) throw InvalidInput(fmt::format("{} has no prior, whose parameters could be identified", name));
  experiment::ChosenPriors priors(setup.scenario, names, violations);
  for (const auto& [key, text] : of_prior) priors.set(key, text, violations);
  violations.throw_if_any();
  setup.prior = priors.prior();
  return setup;
}

std::vector<study::Log> read_logs(const std::vector<std::string>& paths, const Setup& setup, Violations& violations) {
  std::vector<study::Log> logs;
  for (const std::string& path : paths) {
    try {
      recording::ReadOptions plain = setup.options.read;
      plain.average = false;
      recording::Recording recording = recording::read_file(path, setup.scenario.task, setup.options.read);
      const Matrix measured = recording::read_file(path, setup.scenario.task, plain).episode.states;
      for (const std::string& note : recording.notes) fmt::print("{}: {}\n", printable(path), printable(note));
      logs.push_back({fs::path(path).stem().string(), std::move(recording.episode), measured});
    } catch (const InvalidInput& error) {
      for (const std::string& line : error.violations()) violations.add(line);
    }
  }
  return logs;
}

void check_out(const std::optional<std::string>& out, Violations& violations) {
  if (!out) return;
  std::error_code ignored;
  violations.require(!out->empty(), "--out names no folder");
  violations.require(!fs::exists(*out, ignored),
                     fmt::format("{} exists already; --out DIR names another folder", *out));
}

void write(const fs::path& folder, const study::Study& study, const study::Problem& problem, const std::string& robot) {
  fs::create_directories(folder);
  for (const auto& [name, text] : study::csv_files(study, problem)) files::write_file(folder / name, text);
  files::write_file(folder / "identify.html", study::page(study, problem, robot));
  fmt::print("\n{} opens in a browser; tables are beside it\n", printable((folder / "identify.html").string()));
}

}  // namespace

int identify(const experiment::Catalogue& built_in, const IdentifyArguments& arguments) {
  Violations violations;
  experiment::Catalogue catalogue = built_in;
  if (arguments.robot.ends_with(".toml"))
    catalogue = built_in.with_robot(files::read_file(arguments.robot, files::Links::follow), arguments.robot,
                                    fs::path(arguments.robot).parent_path());
  const Index threads = threads_of(arguments.threads, violations);
  check_out(arguments.out, violations);
  const Setup setup = set_up(catalogue, arguments, violations);
  const std::vector<study::Log> logs = read_logs(arguments.logs, setup, violations);
  const std::vector<study::Log> held_out = read_logs(arguments.held_out, setup, violations);
  violations.throw_if_any();
  const study::Problem problem{setup.scenario.task, *setup.prior, logs, held_out};
  StatusLine line;
  const auto evaluator =
      make_stoppable(make_thread_evaluator(static_cast<int>(threads)), [] { return caught_signal() != 0; });
  try {
    const SignalWatch watch([] { return std::string("interrupted: nothing was written"); });
    const study::Study study = study::study_logs(
        problem, setup.options.study, *evaluator,
        [&](const Progress& progress) { line.show(fmt::format("learning from {} …", progress.phase)); });
    line.clear();
    for (const auto& [title, lines] : study::summary(study, problem)) {
      fmt::print("\n{}\n", title);
      for (const std::string& text : lines) fmt::print("  {}\n", printable(text));
    }
    if (arguments.out) write(*arguments.out, study, problem, setup.scenario.name);
    return kSuccess;
  } catch (const Interrupted&) {
    line.clear();
    complain("interrupted: nothing was written");
    return exit_code_of_signal();
  }
}

}  // namespace rehearse::apps
