// A robot that Rehearse does not drive: `ask`, `tell` and `status`.
#include "rehearse/experiment/ask_tell.hpp"

#include <algorithm>
#include <functional>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/catalogue.hpp"
#include "apps/cli/arguments.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/complain.hpp"
#include "apps/cli/limit_text.hpp"
#include "apps/cli/on_console.hpp"
#include "apps/cli/program.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/experiment/kept_robot.hpp"
#include "rehearse/experiment/priors.hpp"
#include "rehearse/experiment/run_folder.hpp"
#include "rehearse/experiment/tables.hpp"

namespace rehearse::apps {
namespace {

using experiment::TrialRecord;

Index threads_or_throw(const std::optional<std::string>& text) {
  Violations violations;
  const Index threads = threads_of(text, violations);
  violations.throw_if_any();
  return threads;
}

template <class Variables>
std::string columns(const Variables& variables) {
  std::vector<std::string> names;
  names.reserve(variables.size());
  for (const auto& variable : variables) names.push_back(with_unit(variable.name, variable.unit));
  return fmt::format("{}", fmt::join(names, ", "));
}

void print_parameters(const TrialRecord& trial, const experiment::Resolved& resolved) {
  const std::vector<std::string> names = experiment::tunable_names(resolved.prior);
  const ParameterSpace space = resolved.prior ? resolved.prior->space : ParameterSpace();
  for (std::size_t i = 0; i < std::min(trial.phi.size(), names.size()); ++i) {
    const auto interval = i < trial.phi_intervals.size() ? trial.phi_intervals[i] : std::nullopt;
    put("  {} = {}{}{}\n", names[i], experiment::phi_text(resolved.spec.prior, i, trial.phi[i]),
        unit_text(space[space.find(names[i])].unit),
        interval ? fmt::format(", 95 %: {:.4g} to {:.4g}", interval->low, interval->high) : "");
  }
  for (const std::string& warning : trial.warnings) put("  {}\n", warning);
}

/// Prints the limits' risks before the trial, the one nearest to what it allows first.
void print_risks(std::vector<experiment::LimitRecord> limits) {
  std::ranges::stable_sort(limits, std::greater(), [](const auto& l) { return l.predicted.value_or(1) / l.allowed; });
  for (const experiment::LimitRecord& limit : limits) {
    if (!limit.predicted) {
      put("  limit {}: its risk is not known\n", limit.limit);
      continue;
    }
    put("  limit {}: risk {}, {:.3g} % is allowed: {}\n", limit.limit, risk_text(limit, "95 %: "), 100 * limit.allowed,
        limit.safe() ? "safe" : "not safe");
  }
}

void print_expected_file(const Task& task, const std::string& folder) {
  const auto own =
      static_cast<std::size_t>(task.actuators().own_states());  // what is remembered follows from the actions
  put("then: {}\n  columns: time [s], {}, {}\n", command_line({"tell", folder, "EPISODE.csv"}),
      columns(std::span(task.states).first(own)), columns(task.actions));
}

/// Prints the files of a policy with the commands that test them. One that nobody can describe is JSON alone.
void print_files(const std::filesystem::path& folder) {
  const auto in = [&](const char* name) { return quoted((folder / name).string()); };
  if (std::filesystem::exists(folder / "policy.h")) {
    put("  C: policy.h, its test: cc -std=c99 -DREHEARSE_POLICY_MAIN -x c {} -o {} -lm && {}\n", in("policy.h"),
        in("test"), in("test"));
    put("  Python with NumPy: policy.py, its test: python3 {}\n", in("policy.py"));
  }
  put("  numbers: policy.json\n");
}

void print_asked(const experiment::Resolved& resolved, const TrialRecord& trial, const std::string& folder,
                 const std::filesystem::path& files) {
  const Task& task = resolved.scenario.task;
  put("trial {}: run the policy of {} for {} steps of {} s\n", trial.trial, files.string(), task.horizon, task.dt_s);
  print_files(files);
  if (resolved.stand_in())
    put("  to try it on the prior first: {}\n",
        command_line({"evaluate", folder, "--trial", std::to_string(trial.trial), "--robustness"}));
  if (trial.predicted_return) put("  predicted return {:.4g}\n", *trial.predicted_return);
  print_risks(trial.limits);
  print_parameters(trial, resolved);
  for (const std::string& note : trial.notes) put("  {}\n", note);
  print_expected_file(task, folder);
}

std::string steps_text(const Episode& episode, double dt_s) {
  return fmt::format("{}, {:.4g} s", counted(episode.steps(), "step"), seconds(episode.steps(), dt_s));
}

void print_logs(const std::vector<experiment::Log>& logs, const Task& task) {
  for (const experiment::Log& log : logs) {
    put("log {}: {}\n", log.name, steps_text(log.episode, task.dt_s));
    for (const std::string& note : log.notes) put("  {}\n", note);
  }
}

void print_told(const experiment::TellResult& told, const std::string& folder) {
  if (told.known_before) put("told before, nothing is changed:\n");
  print_logs(told.logs, told.resolved.scenario.task);
  if (told.dropped) put("the policy that was asked for is dropped: it was made without these logs\n");
  if (told.trial && told.known_before) {  // else the console has said it
    put("trial {}: return {:.4g}\n", told.trial->trial, told.trial->total_reward);
    for (const std::string& note : told.trial->notes) put("  {}\n", note);
  }
  put("next: {}\n", told.still_asked ? command_line({"tell", folder, "EPISODE.csv"}) : command_line({"ask", folder}));
}

std::string after_comma(const std::string& text) { return text.empty() ? "" : ", " + text; }

void print_trials(const std::vector<TrialRecord>& trials) {
  for (const TrialRecord& trial : trials)
    put("trial {}: return {:.4g}{}{}{}\n", trial.trial, trial.total_reward,
        trial.predicted_return ? fmt::format(", {:.4g} was predicted", *trial.predicted_return) : "",
        trial.cut_short ? ", stopped by no fault of the policy"
        : !trial.solved ? ""
        : *trial.solved ? ", solved"
                        : ", not solved",
        after_comma(broken_text(trial.limits)));
}

/// The status, and whether the robot is another program's, whose functions this one has not.
std::pair<experiment::RunStatus, bool> status_in(const experiment::Catalogue& catalogue, const std::string& folder) {
  try {
    return {experiment::status_of(catalogue, folder), false};
  } catch (const InvalidInput&) {
    return {experiment::status_of(to_look(catalogue), folder), true};  // what else is wrong is so here, too
  }
}

/// True if Rehearse drives the plant and the run has reached its end.
bool is_complete(const experiment::Resolved& resolved, const experiment::History& history) {
  if (history.trials.empty() || resolved.spec.trials == 0 || !resolved.scenario.make_plant) return false;
  return resolved.spec.ends_with(history.done(), history.ends_solved());
}

}  // namespace

int ask(const experiment::Catalogue& catalogue, const AskArguments& arguments) {
  Console console(Console::Begin::silent);
  return on_console(arguments.folder, threads_or_throw(arguments.threads), console,
                    command_line({"ask", arguments.folder}), [&](const experiment::RunOptions& options) {
                      const experiment::AskResult asked = experiment::ask_run(catalogue, arguments.folder, options);
                      console.clear_line();
                      print_asked(asked.resolved, asked.trial, arguments.folder, asked.folder);
                    });
}

namespace {

int take_back(const experiment::Catalogue& catalogue, const TellArguments& arguments) {
  if (!arguments.files.empty() || arguments.stopped || arguments.no_fault)
    throw InvalidInput("--undo takes the last file back that was told, and goes with nothing else");
  Console console(Console::Begin::silent);
  return on_console(arguments.folder, threads_or_throw(arguments.threads), console,
                    command_line({"tell", arguments.folder, "--undo"}), [&](const experiment::RunOptions& options) {
                      const auto [trial, files] = experiment::take_back(catalogue, arguments.folder, options);
                      console.clear_line();
                      put("{}\n", trial ? fmt::format("trial {} is taken back, and is to come", *trial)
                                        : std::string("the logs are taken back"));
                      for (const auto& file : files) put("  {} has what was told\n", file.string());
                      put("next: {}\n", trial ? command_line({"tell", arguments.folder, "EPISODE.csv"})
                                              : command_line({"ask", arguments.folder}));
                    });
}

}  // namespace

int tell(const experiment::Catalogue& built_in, const TellArguments& arguments) {
  if (arguments.undo) return take_back(built_in, arguments);
  if (arguments.files.empty()) throw InvalidInput("FILE.csv is required: what the robot did");
  if (arguments.no_fault && !arguments.stopped) throw InvalidInput("--no-fault goes with --stopped \"REASON\"");
  experiment::TellRequest request{.files = {arguments.files.begin(), arguments.files.end()}, .stopped = {}};
  if (arguments.stopped) request.stopped = {*arguments.stopped, !arguments.no_fault};
  std::vector<std::string> again = {"tell", arguments.folder};  // which changes nothing if it was told
  again.insert(again.end(), arguments.files.begin(), arguments.files.end());
  if (arguments.stopped) again.insert(again.end(), {"--stopped", *arguments.stopped});
  if (arguments.no_fault) again.emplace_back("--no-fault");
  const experiment::Catalogue catalogue = experiment::with_robot_of_run(built_in, arguments.folder);
  Console console(Console::Begin::silent);
  return on_console(arguments.folder, threads_or_throw(arguments.threads), console, command_line(again),
                    [&](const experiment::RunOptions& options) {
                      const experiment::TellResult told =
                          experiment::tell_run(catalogue, arguments.folder, request, options);
                      console.clear_line();
                      print_told(told, arguments.folder);
                      if (told.trial) put_second_look(experiment::second_look(catalogue, arguments.folder, options));
                    });
}

int status(const experiment::Catalogue& catalogue, const StatusArguments& arguments) {
  const std::string& folder = arguments.folder;
  const auto [found, is_of_another_program] = status_in(catalogue, folder);
  const auto& [resolved, history, of_run] = found.run;
  const experiment::Spec& spec = resolved.spec;
  const Task& task = resolved.scenario.task;
  const std::string prior = spec.prior.empty() ? "" : fmt::format(" from prior {}", spec.prior);
  put("{} learned by {}{}, seed {}\n", spec.scenario, spec.learner, prior, spec.seed);
  print_logs(history.logs, task);
  print_trials(history.trials);
  if (history.done() > 0) {
    const TrialRecord& best = experiment::best_trial(history.trials);
    const std::string which = best.cut_short ? "none: each trial was stopped"
                                             : fmt::format("trial {}, return {:.4g}", best.trial, best.total_reward);
    put("best: {}, after {:.4g} s on the robot in all\n", which, history.trials.back().interaction_s);
  }
  const std::filesystem::path next = std::filesystem::path(folder) / experiment::kNextFolder;
  if (found.in_use)
    put("a process is at work on it\n");
  else if (is_of_another_program)
    put("next: {} shows it; the program whose functions the robot has goes on, in Python: rehearse.open_run(\"{}\", "
        "robot)\n",
        command_line({"report", folder}), folder);
  else if (history.asked && std::filesystem::exists(next / "policy.json"))
    print_asked(resolved, *history.asked, folder, next);
  else if (experiment::was_told(history))
    put("next: {}\n", command_line({"ask", folder}));
  else if (is_complete(resolved, history))
    put("next: {} shows it; {} goes on\n", command_line({"report", folder}),
        command_line({"resume", folder, "--trials", std::to_string(2 * history.done())}));
  else if (spec.trials > history.done())
    put("next: {}, which drives the plant, or {}\n", command_line({"resume", folder}), command_line({"ask", folder}));
  else
    put("next: {}{}\n", command_line({"ask", folder}),
        history.done() == 0 ? ", or tell it logs of other controllers first" : "");
  return kSuccess;
}

}  // namespace rehearse::apps
