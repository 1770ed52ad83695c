#include "python/bindings/runs.hpp"

#include <filesystem>
#include <functional>

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "python/bindings/policy.hpp"
#include "python/bindings/work.hpp"
#include "rehearse/experiment/ask_tell.hpp"
#include "rehearse/experiment/exported_policy.hpp"
#include "rehearse/experiment/given_policy.hpp"
#include "rehearse/experiment/kept_robot.hpp"
#include "rehearse/experiment/past_run.hpp"
#include "rehearse/experiment/preset_check.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/experiment/run.hpp"
#include "rehearse/experiment/second_look.hpp"
#include "rehearse/experiment/tables.hpp"

namespace rehearse::python {
namespace {

using experiment::Spec;
using Options = std::vector<std::pair<std::string, std::string>>;
using Strings = std::vector<std::string>;

/// A run that is to begin.
struct Request {
  std::string scenario, learner, prior, preset;
  std::string policy;  // to begin with, as JSON; empty: none
  Index trials = 10, seed = 1;
  bool until_solved = false;
  Options options;
};

experiment::Resolved resolved(const experiment::Catalogue& catalogue, const Request& request) {
  Spec spec{.scenario = request.scenario,
            .learner = request.learner,
            .prior = request.prior,
            .trials = request.trials,
            .until_solved = request.until_solved,
            .seed = request.seed};
  if (spec.learner.empty()) spec.learner = experiment::default_learner(catalogue, spec);
  if (!request.preset.empty()) spec = experiment::with_preset(catalogue, spec, request.preset);
  for (const auto& option : request.options) spec.options.push_back(option);
  if (!request.policy.empty()) spec = experiment::with_start(catalogue, spec, request.policy, "policy");
  return experiment::resolve(catalogue, spec);
}

/// Does the work. If Ctrl-C stops it, the exception has a note on how to go on. folder: may become known during the
/// work.
void resumable(const Robot& robot, const std::filesystem::path& folder, const std::function<void()>& work) {
  try {
    work();
  } catch (const py::error_already_set& error) {
    std::error_code ignored;
    const bool silent = error.matches(PyExc_KeyboardInterrupt) && py::str(error.value()).cast<std::string>().empty();
    if (!silent || !std::filesystem::exists(folder, ignored)) throw;
    PyErr_SetString(PyExc_KeyboardInterrupt, fmt::format("interrupted: rehearse.resume(\"{}\"{}) goes on",
                                                         folder.string(), robot.has_functions() ? ", robot" : "")
                                                 .c_str());
    throw py::error_already_set();
  }
}

/// Other readings of the trials, such as a delay, where trials do not get better; none where nothing is found. What a
/// prior raises there is no fault of the trials, which are done.
Strings other_readings(const Robot& robot, const experiment::Catalogue& catalogue, const std::filesystem::path& folder,
                       const experiment::RunOptions& options) {
  auto [readings, read_on] = experiment::second_look(catalogue, folder, options);
  const py::gil_scoped_acquire locked;
  robot.failure()->forget_errors();
  if (!readings.empty()) readings.push_back(read_on);
  return readings;
}

/// Makes the folder, and runs all trials. Returns the folder.
std::string learn(const Robot& robot, const Request& request, const std::string& out, const Settings& settings) {
  std::filesystem::path folder = out;
  const auto run_all = [&](const Robot& own, const experiment::RunOptions& options) {
    const experiment::Catalogue catalogue = own.catalogue();
    const experiment::Resolved run = resolved(catalogue, request);
    own.try_out(run.scenario);
    warn(run.warnings);
    if (folder.empty()) folder = default_folder(run.spec);
    experiment::start_run(catalogue, run.spec, folder, options);
    warn(other_readings(own, catalogue, folder, options));
  };
  resumable(robot, folder, [&] { work_with(robot, settings, run_all); });
  return folder.string();
}

void resume(const Robot& robot, const std::string& folder, std::optional<Index> trials, const Settings& settings) {
  const auto go_on = [&](const Robot& own, const experiment::RunOptions& options) {
    const auto until = trials ? std::optional<experiment::Until>(*trials) : std::nullopt;
    const experiment::Catalogue catalogue = experiment::with_robot_of_run(own.catalogue(), folder);
    experiment::resume_run(catalogue, folder, until, options);
    warn(other_readings(own, catalogue, folder, options));
  };
  resumable(robot, folder, [&] { work_with(robot, settings, go_on); });
}

Policy ask(const Robot& robot, const std::string& folder, const Settings& settings, py::dict& trial) {
  std::optional<experiment::AskResult> asked;
  std::optional<Policy> policy;
  work_with(robot, settings, [&](const Robot& own, const experiment::RunOptions& options) {
    asked = experiment::ask_run(own.catalogue(), folder, options);
    policy.emplace(policy_of(asked->trial, asked->resolved.scenario),
                   experiment::exported_policy(asked->resolved, asked->trial, nullptr));
  });
  trial = trial_of(asked->trial, experiment::tunable_names(asked->resolved.prior));
  return *policy;
}

py::dict tell(const Robot& robot, const std::string& folder, const Strings& files,
              const std::optional<experiment::Stop>& stopped, const Settings& settings) {
  std::optional<experiment::TellResult> told;
  Strings readings;
  work_with(robot, settings, [&](const Robot& own, const experiment::RunOptions& options) {
    experiment::TellRequest request{.files = {files.begin(), files.end()}, .stopped = stopped};
    const experiment::Catalogue catalogue = experiment::with_robot_of_run(own.catalogue(), folder);
    told = experiment::tell_run(catalogue, folder, request, options);
    if (told->trial) readings = other_readings(own, catalogue, folder, options);
  });
  Strings logs, notes;
  for (const experiment::Log& log : told->logs) {
    logs.push_back(log.name);
    notes.insert(notes.end(), log.notes.begin(), log.notes.end());
  }
  if (told->trial) notes = told->trial->notes;
  notes.insert(notes.end(), readings.begin(), readings.end());
  return py::dict(py::arg("trial") = told->trial ? std::optional(told->trial->trial) : std::nullopt,
                  py::arg("total_reward") = told->trial ? std::optional(told->trial->total_reward) : std::nullopt,
                  py::arg("logs") = logs, py::arg("known_before") = told->known_before,
                  py::arg("dropped") = told->dropped, py::arg("notes") = notes);
}

py::dict take_back(const Robot& robot, const std::string& folder, const Settings& settings) {
  experiment::TakeBackResult taken;
  work_with(robot, settings, [&](const Robot& own, const experiment::RunOptions& options) {
    taken = experiment::take_back(own.catalogue(), folder, options);
  });
  Strings files;
  for (const std::filesystem::path& file : taken.files) files.push_back(file.string());
  return py::dict(py::arg("trial") = taken.trial, py::arg("files") = files);
}

/// The contents of a run folder, without its tables.
py::dict describe(const Robot& robot, const std::string& folder) {
  const experiment::RunStatus status = experiment::status_of(robot.to_look(), folder);
  const auto& [resolved, history, catalogue] = status.run;
  const std::vector<std::string> names = experiment::tunable_names(resolved.prior);
  const Spec& spec = resolved.spec;
  py::list trials;
  for (const experiment::TrialRecord& trial : history.trials) trials.append(trial_of(trial, names));
  py::object asked = py::none(), best = py::none();
  if (!history.trials.empty()) best = trial_of(experiment::best_trial(history.trials), names);
  if (history.asked) asked = trial_of(*history.asked, names);
  py::dict options;
  for (const auto& [name, value] : spec.options) options[py::str(name)] = value;
  py::list states, actions;
  for (const StateVariable& state : resolved.scenario.task.states)
    states.append(py::make_tuple(state.name, state.unit));
  for (const ActionVariable& action : resolved.scenario.task.actions)
    actions.append(py::make_tuple(action.name, action.unit));
  return py::dict(py::arg("robot") = spec.scenario, py::arg("learner") = spec.learner, py::arg("prior") = spec.prior,
                  py::arg("seed") = spec.seed, py::arg("planned") = spec.trials,
                  py::arg("until_solved") = spec.until_solved, py::arg("options") = options, py::arg("trials") = trials,
                  py::arg("states") = states, py::arg("actions") = actions,
                  py::arg("dt_s") = resolved.scenario.task.dt_s, py::arg("horizon") = resolved.scenario.task.horizon,
                  py::arg("in_use") = status.in_use, py::arg("asked") = asked, py::arg("best") = best);
}

Policy policy(const Robot& robot, const std::string& folder, std::optional<Index> trial) {
  const experiment::PastRun run = experiment::read_run(robot.to_look(), folder);
  return {policy_of(run.trial(trial), run.resolved.scenario), experiment::exported_policy(run, trial)};
}

}  // namespace

void add_runs(py::module_& module) {
  using namespace py::literals;
  module.def(
      "learn",
      [](const Robot& robot, const std::string& scenario, const std::string& learner, const std::string& prior,
         const std::string& preset, const std::string& policy, Index trials, bool until_solved, Index seed,
         const Options& options, const std::string& out, int threads, py::object listener) {
        return learn(robot, {scenario, learner, prior, preset, policy, trials, seed, until_solved, options}, out,
                     {threads, std::move(listener)});
      },
      "robot"_a, "scenario"_a, "learner"_a, "prior"_a, "preset"_a, "policy"_a, "trials"_a, "until_solved"_a, "seed"_a,
      "options"_a, "out"_a, "threads"_a, "listener"_a);
  module.def(
      "resume",
      [](const Robot& robot, const std::string& folder, std::optional<Index> trials, int threads, py::object listener) {
        resume(robot, folder, trials, {threads, std::move(listener)});
      },
      "robot"_a, "folder"_a, "trials"_a, "threads"_a, "listener"_a);
  module.def(
      "ask",
      [](const Robot& robot, const std::string& folder, int threads, py::object listener) {
        py::dict trial;
        Policy policy = ask(robot, folder, {threads, std::move(listener)}, trial);
        return py::make_tuple(std::move(policy), trial);
      },
      "robot"_a, "folder"_a, "threads"_a, "listener"_a);
  module.def(
      "tell",
      [](const Robot& robot, const std::string& folder, const Strings& files, const std::optional<std::string>& stopped,
         bool at_fault, int threads) {
        std::optional<experiment::Stop> stop;
        if (stopped) stop = {*stopped, at_fault};
        return tell(robot, folder, files, stop, {threads});
      },
      "robot"_a, "folder"_a, "files"_a, "stopped"_a, "at_fault"_a, "threads"_a);
  module.def(
      "take_back",
      [](const Robot& robot, const std::string& folder, int threads) { return take_back(robot, folder, {threads}); },
      "robot"_a, "folder"_a, "threads"_a);
  module.def("describe", &describe, "robot"_a, "folder"_a);
  module.def("policy", &policy, "robot"_a, "folder"_a, "trial"_a);
}

}  // namespace rehearse::python
