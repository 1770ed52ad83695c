#include "apps/cli/parser.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/cli/help.hpp"
#include "apps/cli/parse_errors.hpp"
#include "apps/cli/program.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/core/options.hpp"

namespace rehearse::apps {
namespace {

template <class Command, class T>
CLI::Option* add(Command* command, const std::string& name, T& value, const std::string& help, const char* type) {
  return command->add_option(name, value, help)->type_name(type);
}

void add_list(CLI::App& app, ListArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("list", "Show the scenarios, their priors, and the learners, or the options of one");
  add(command, "NAME", arguments.name,
      "A scenario, the file of a robot of your own, a learner or `identify`, to be shown with its options", "");
  command->add_flag("--json", arguments.json, "As JSON, with all options");
  command->add_flag("--expert", arguments.expert, "With the options of NAME that only experts need, too");
  command->add_flag("--options", arguments.options,
                    "With all options that --set can change, their defaults, and what is published of them");
  command->add_flag("--schema", arguments.schema, "The JSON schema of robots' files, for editors");
  command->footer(fmt::format(kListExample, program_name()));
}

void add_new(CLI::App& app, NewArguments& arguments) {
  CLI::App* command = app.add_subcommand("new", "Begin a robot of your own: a file with comments, NAME.toml");
  add(command, "NAME", arguments.name, "The robot's name: letters, digits, - and _", "")->required();
  command->footer(fmt::format(kNewExample, program_name()));
}

void add_check(CLI::App& app, CheckArguments& arguments) {
  CLI::App* command = app.add_subcommand("check", "Say what a robot is, and try its plant and priors");
  add(command, "ROBOT.toml", arguments.robot,
      "The file, for instance examples/robots/pendulum.toml, or a robot that `list` shows", "")
      ->required();
  add(command, "--out", arguments.out,
      "Also show the motion of an episode of random actions, as a page for the browser", "FILE.html");
  command->add_flag("--no-plant", arguments.no_plant,
                    "Leave the plant alone, which may be a real robot: the first prior plays it");
  command->footer(fmt::format(kNewExample, program_name()));
}

void add_learn(CLI::App& app, LearnArguments& arguments) {
  CLI::App* command = app.add_subcommand("learn", "Learn a policy for a scenario");
  add(command, "SCENARIO", arguments.scenario,
      "A scenario that `list` shows, the file of a robot of your own, or the spec.toml of a run to repeat", "")
      ->required();
  add(command, "--learner", arguments.learner, "One of `list`. Default: gp-mi, without a prior black-drops", "NAME");
  add(command, "--prior", arguments.prior,
      "The guess to start from: one of the scenario's, several as a,b,c for a learner that can choose, or `oracle`, "
      "the plant's own dynamics. Default: the scenario's first",
      "NAME");
  add(command, "--preset", arguments.preset,
      "Options that go together: a preset that `list` shows, for instance as-published, or a file FILE.toml; --set "
      "comes after it",
      "NAME");
  add(command, "--policy", arguments.policy,
      "A policy to begin with, as `export` wrote it: searches start from it, too, and without a prior it is the first "
      "trial",
      "FILE.json");
  add(command, "--trials", arguments.trials,
      "Trials on the plant; 0: none, trials come by `ask` and `tell`. Default: 10", "N");
  command->add_flag("--until-solved", arguments.until_solved, "End before, with a trial that solves the task");
  add(command, "--seed", arguments.seed, "Seed of all random numbers: the same one gives the same run. Default: 1",
      "S");
  add(command, "--threads", arguments.threads,
      "Threads to compute with; results do not depend on it. Default: all cores", "K");
  add(command, "--out", arguments.out,
      "The run folder, which must not exist. Default: runs/SCENARIO-LEARNER-PRIOR-SEED", "DIR");
  add(command, "--set", arguments.set, "Set an option that `list SCENARIO` or `list LEARNER` shows; may be repeated",
      "KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->footer(fmt::format(kLearnExample, program_name()));
}

void add_resume(CLI::App& app, ResumeArguments& arguments) {
  CLI::App* command = app.add_subcommand("resume", "Continue a run that was interrupted, or extend it");
  add(command, "DIR", arguments.folder, "The run folder", "")->required();
  add(command, "--trials", arguments.trials,
      "Trials in all, those done included, even where a run with --until-solved ended before. Default: as many as were "
      "asked for",
      "N");
  add(command, "--threads", arguments.threads, "Threads to compute with. Default: all cores", "K");
  command->footer(fmt::format(kResumeExample, program_name()));
}

void add_ask(CLI::App& app, AskArguments& arguments) {
  CLI::App* command = app.add_subcommand("ask", "Get the next policy, for a robot that Rehearse does not drive");
  add(command, "DIR", arguments.folder, "The run folder", "")->required();
  add(command, "--threads", arguments.threads, "Threads to compute with. Default: all cores", "K");
  command->footer(fmt::format(kAskExample, program_name()));
}

void add_tell(CLI::App& app, TellArguments& arguments) {
  CLI::App* command = app.add_subcommand("tell", "Tell what a robot did: the trial that was asked for, or old logs");
  add(command, "DIR", arguments.folder, "The run folder", "")->required();
  command
      ->add_option("FILE.csv", arguments.files,
                   "The episode of the trial that was asked for; before the first, logs of other controllers")
      ->option_text(" ");
  add(command, "--stopped", arguments.stopped,
      "Why the operator cut the episode short. The steps that are left out count as failed", "REASON");
  command->add_flag("--no-fault", arguments.no_fault,
                    "With --stopped: it was not the policy's fault, so nothing counts as failed");
  command->add_flag("--undo", arguments.undo,
                    "Take the last file that was told back: the folder is as before it, and the file is kept");
  add(command, "--threads", arguments.threads, "Threads to compute with. Default: all cores", "K");
  command->footer(fmt::format(kAskExample, program_name()));
}

void add_status(CLI::App& app, StatusArguments& arguments) {
  CLI::App* command = app.add_subcommand("status", "Say what a run knows, and what comes next");
  add(command, "DIR", arguments.folder, "The run folder", "")->required();
  command->footer(fmt::format(kAskExample, program_name()));
}

void add_campaign(CLI::App& app, CampaignArguments& arguments) {
  CLI::App* command = app.add_subcommand("campaign", "Do a grid of runs, or continue it: learners × priors × seeds");
  add(command, "FILE", arguments.file, "The campaign file, for instance campaigns/pendubot-short.toml", "")->required();
  add(command, "--out", arguments.out,
      "The folder of the campaign; one that was begun is continued. Default: runs/ and the file's name", "DIR");
  add(command, "--threads", arguments.threads,
      "Threads to compute with in all, one a run where there are enough runs; with mpirun, of each process. Default: "
      "all cores",
      "K");
  add(command, "--share", arguments.share,
      "Be the K-th of N processes that work on the folder at the same time, and do every N-th run; the same command "
      "without it, when all have ended, writes the tables",
      "K/N");
  command->add_flag("--dry-run", arguments.dry_run, "Check the file and say what would be done, without doing it");
  command->add_flag("--check-claims", arguments.check_claims, "Exit with status 1 if a claim fails");
  command->footer(fmt::format(kCampaignExample, program_name()));
}

void add_identify(CLI::App& app, IdentifyArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("identify", "Learn a robot's parameters, and what no parameter explains, from logs");
  add(command, "ROBOT", arguments.robot, "The file of a robot of your own, or a scenario that `list` shows", "")
      ->required();
  add(command, "LOG.csv", arguments.logs, "What the robot did: CSV files with columns of time, states and actions", "")
      ->required();
  add(command, "--prior", arguments.prior, "The guess to start from. Default: the robot's first", "NAME");
  add(command, "--held-out", arguments.held_out, "Logs to forecast, of which nothing is learned", "LOG.csv")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add(command, "--threads", arguments.threads,
      "Threads to compute with; results do not depend on it. Default: all cores", "K");
  add(command, "--out", arguments.out,
      "The folder of tables and a page, which must not exist. Default: none is written", "DIR");
  add(command, "--set", arguments.set, "Set an option that `list identify` shows, or one of the robot; may be repeated",
      "KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->footer(fmt::format(kIdentifyExample, program_name()));
}

void add_report(CLI::App& app, ReportArguments& arguments) {
  CLI::App* command = app.add_subcommand("report", "Show a run or a campaign as a page for the browser");
  add(command, "DIR", arguments.folder, "The folder of the run or the campaign", "")->required();
  add(command, "--out", arguments.out, "The page. Default: report.html in the folder", "FILE.html");
  command->footer(fmt::format(kReportExample, program_name()));
}

void add_replay(CLI::App& app, ReplayArguments& arguments) {
  CLI::App* command = app.add_subcommand("replay", "Show the motion of one trial as a page for the browser");
  add(command, "DIR", arguments.folder, "The run folder", "")->required();
  add(command, "--trial", arguments.trial, "Which trial, from 1", "N")->required();
  add(command, "--out", arguments.out, "The page. Default: for instance replay-003.html in the folder", "FILE.html");
  command->footer(fmt::format(kReportExample, program_name()));
}

void add_export(CLI::App& app, ExportArguments& arguments) {
  CLI::App* command = app.add_subcommand("export", "Write a learned policy as C, as JSON, or as a module for NumPy");
  add(command, "DIR", arguments.folder, "The run folder", "")->required();
  add(command, "--trial", arguments.trial, "The trial whose policy it is. Default: the one with the highest return",
      "N");
  add(command, "--out", arguments.out, "The file: .h is C, .json JSON, .py Python", "FILE")->required();
  command->footer(fmt::format(kExportExample, program_name()));
}

void add_evaluate(CLI::App& app, EvaluateArguments& arguments) {
  CLI::App* command = app.add_subcommand("evaluate", "Try a learned policy in more, longer or other episodes");
  add(command, "DIR", arguments.folder, "The run folder", "")->required();
  add(command, "--trial", arguments.trial, "The trial whose policy it is. Default: the one with the highest return",
      "N");
  add(command, "--policy", arguments.policy, "A policy that `export` wrote as JSON, instead", "FILE.json");
  add(command, "--episodes", arguments.episodes, "Episodes on the scenario's plant. Default: 100", "M");
  add(command, "--seconds", arguments.seconds, "Length of an episode. Default: as the task says", "S");
  add(command, "--seed", arguments.seed, "Seed of starts and noise. Default: the run's", "S");
  add(command, "--set", arguments.set,
      "Set an option that `list SCENARIO` shows, for instance plant.m1=0.6; may be repeated", "KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_flag("--robustness", arguments.robustness,
                    "Change one parameter of the plant at a time by up to a quarter; `report` shows the result");
  add(command, "--threads", arguments.threads,
      "Threads to compute with, each with a plant of its own; results do not depend on it. Default: all cores", "K");
  add(command, "--out", arguments.out,
      "The table. Default: evaluation.csv in the folder, or robustness.csv; an older one is kept under another name",
      "FILE.csv");
  command->footer(fmt::format(kEvaluateExample, program_name()));
}

/// CLI11 speaks of what it did not expect; we know what was meant.
void check_command_name(const CLI::App& app, const std::vector<std::string>& words) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    known.push_back(command->get_name());
  if (words.empty())
    throw InvalidInput(fmt::format("a command is missing ({}); see {} --help", fmt::join(known, ", "), program_name()));
  const std::string& given = words.front();
  if (given.starts_with('-') || is_among(given, known)) return;
  throw InvalidInput(fmt::format("unknown command '{}'{}", given, suggestions(given, known)));
}

/// The words behind the program's name, `help COMMAND` as `COMMAND --help`.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words(argv + (argc > 0 ? 1 : 0), argv + argc);
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

}  // namespace

void define(CLI::App& app, Typed& typed) {
  app.set_version_flag("--version", "rehearse " REHEARSE_VERSION, "Show the version");
  app.require_subcommand(1);
  add_list(app, typed.list);
  add_new(app, typed.make_new);
  add_check(app, typed.check);
  add_learn(app, typed.learn);
  add_resume(app, typed.resume);
  add_ask(app, typed.ask);
  add_tell(app, typed.tell);
  add_status(app, typed.status);
  add_campaign(app, typed.campaign);
  add_identify(app, typed.identify);
  add_report(app, typed.report);
  add_replay(app, typed.replay);
  add_export(app, typed.export_policy);
  add_evaluate(app, typed.evaluate);
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    for (CLI::Option* option : command->get_options())
      if (option->get_items_expected_max() == 0) option->disable_flag_override();  // no --until-solved=3
  app.footer(fmt::format(kExample, program_name()));  // last, so that no command takes it over
}

std::optional<Typed> parse(int argc, char** argv, bool silent) {
  CLI::App app(kAbout, program_name());
  Typed typed;
  define(app, typed);
  const std::vector<std::string> words = words_of(argc, argv);
  check_command_name(app, words);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // as CLI11 takes them
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw InvalidInput(why_not_parsed(app, error));
    if (!silent) app.exit(error);  // --help, --version
    return std::nullopt;
  }
  typed.command = app.get_subcommands().front()->get_name();
  return typed;
}

}  // namespace rehearse::apps
