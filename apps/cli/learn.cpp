#include <filesystem>

#include <fmt/format.h>

#include "apps/cli/arguments.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/on_console.hpp"
#include "apps/cli/program.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/given_policy.hpp"
#include "rehearse/experiment/kept_robot.hpp"
#include "rehearse/experiment/preset_check.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/experiment/run.hpp"
#include "rehearse/experiment/run_folder.hpp"
#include "rehearse/experiment/spec_file.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/files/toml_reader.hpp"

namespace rehearse::apps {
namespace {

using experiment::Catalogue, experiment::RunOptions, experiment::Spec, experiment::SpecFile;

void set_numbers(Spec& spec, const std::optional<std::string>& trials, const std::optional<std::string>& seed,
                 Violations& violations) {
  const Fields fields = [&](FieldVisitor& v) { spec.fields(v); };
  set_text(fields, "trials", trials, violations);
  set_text(fields, "seed", seed, violations);
}

/// A TOML file that is named instead of a scenario: a robot, or the spec of a run.
struct GivenFile {
  std::string text;
  bool describes_run = false;
};

std::optional<GivenFile> read_given(const std::string& scenario) {
  if (!scenario.ends_with(".toml")) return std::nullopt;
  GivenFile file{files::read_file(scenario, files::Links::follow)};
  file.describes_run = files::parse_toml(file.text, scenario).contains("run");
  return file;
}

std::optional<SpecFile> spec_file(const LearnArguments& arguments, const std::optional<GivenFile>& file,
                                  Violations& violations) {
  if (!file || !file->describes_run) return std::nullopt;
  const auto given = [&](const char* option) {
    return fmt::format("{} cannot be given with {}, which says it already", option, arguments.scenario);
  };
  violations.require(!arguments.learner, given("--learner"));
  violations.require(!arguments.prior, given("--prior"));
  return SpecFile(file->text, arguments.scenario);
}

/// The catalogue with the robot that the given file describes, or with that of the run that it describes.
Catalogue with_given(const Catalogue& catalogue, const LearnArguments& arguments,
                     const std::optional<GivenFile>& file) {
  if (!file) return catalogue;
  if (!file->describes_run) return with_robot(catalogue, arguments.scenario);
  return experiment::with_robot_of_run(catalogue, std::filesystem::path(arguments.scenario).parent_path());
}

/// Throws the violations that there are, and those of a run's numbers and its learner, whatever the robot.
void check_without_robot(const Catalogue& built_in, const LearnArguments& arguments, Violations& violations) {
  Spec numbers;
  set_numbers(numbers, arguments.trials, arguments.seed, violations);
  if (arguments.learner && !built_in.learner(*arguments.learner))
    violations.add(built_in.why_missing("learner", *arguments.learner));
  violations.throw_if_any();
}

Spec named_spec(const Catalogue& catalogue, const LearnArguments& arguments, Violations& violations) {
  refuse_file_without_ending(catalogue, arguments.scenario);
  Spec spec;
  spec.scenario = catalogue.scenario_name(arguments.scenario);
  spec.prior = arguments.prior.value_or("");
  spec.learner = arguments.learner ? *arguments.learner : experiment::default_learner(catalogue, spec);
  violations.require(!arguments.prior || !arguments.prior->empty(), "--prior names none");
  return spec;
}

/// Makes the spec complete, so that the default folder can be named after it. False: a violation says why not.
bool complete(Spec& spec, const Catalogue& catalogue, const std::optional<SpecFile>& file, Violations& violations) {
  try {
    spec = experiment::resolve(catalogue, spec).spec;
    return true;
  } catch (const InvalidInput& error) {
    for (const std::string& violation : error.violations())
      violations.add(file ? file->located(catalogue, violation) : violation);
    return false;
  }
}

int run_on_console(const Catalogue& catalogue, const std::filesystem::path& folder, Index threads,
                   const std::function<experiment::RunResult(const RunOptions&)>& run) {
  Console console;
  return on_console(folder, threads, console, command_line({"resume", folder.string()}),
                    [&](const RunOptions& options) {
                      console.finished(run(options));
                      put_second_look(experiment::second_look(catalogue, folder, options));
                    });
}

}  // namespace

int learn(const Catalogue& built_in, const LearnArguments& arguments) {
  Violations violations;
  const Index threads = threads_of(arguments.threads, violations);
  auto settings = settings_of(arguments.set, violations);
  violations.require(!arguments.out || !arguments.out->empty(), "--out names no folder");
  if (arguments.out && !arguments.out->empty())
    violations.attempt([&] { experiment::RunFolder::require_absent(*arguments.out); });
  std::optional<std::string> policy;
  if (arguments.policy) violations.attempt([&] { policy = files::read_file(*arguments.policy, files::Links::follow); });
  Catalogue catalogue;
  std::optional<SpecFile> file;
  Spec spec;
  const bool known = violations.attempt([&] {
    const std::optional<GivenFile> given = read_given(arguments.scenario);
    catalogue = with_given(built_in, arguments, given);
    file = spec_file(arguments, given, violations);
    spec = file ? file->spec() : named_spec(catalogue, arguments, violations);
  });
  if (!known) check_without_robot(built_in, arguments, violations);
  set_numbers(spec, arguments.trials, arguments.seed, violations);
  spec.until_solved |= arguments.until_solved;
  if (arguments.preset) violations.attempt([&] { spec = experiment::with_preset(catalogue, spec, *arguments.preset); });
  for (auto& setting : settings) spec.options.push_back(std::move(setting));
  if (complete(spec, catalogue, file, violations) && policy)
    violations.attempt([&] { spec = experiment::with_start(catalogue, spec, *policy, *arguments.policy); });
  violations.throw_if_any();
  const std::filesystem::path folder = arguments.out.value_or(experiment::default_folder(spec));
  return run_on_console(catalogue, folder, threads, [&](const RunOptions& options) {
    return experiment::start_run(catalogue, spec, folder, options);
  });
}

int resume(const Catalogue& built_in, const ResumeArguments& arguments) {
  Violations violations;
  Spec numbers;
  set_numbers(numbers, arguments.trials, {}, violations);
  const Index threads = threads_of(arguments.threads, violations);
  violations.throw_if_any();
  const auto until = arguments.trials ? std::optional<experiment::Until>(numbers.trials) : std::nullopt;
  const Catalogue catalogue = experiment::with_robot_of_run(built_in, arguments.folder);
  return run_on_console(catalogue, arguments.folder, threads, [&](const RunOptions& options) {
    return experiment::resume_run(catalogue, arguments.folder, until, options);
  });
}

}  // namespace rehearse::apps
