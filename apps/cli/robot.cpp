// A robot of one's own: `new` and `check`.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/catalogue.hpp"
#include "apps/cli/arguments.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/complain.hpp"
#include "apps/cli/output_file.hpp"
#include "apps/cli/program.hpp"
#include "apps/cli/report_page.hpp"
#include "apps/cli/signals.hpp"
#include "apps/cli/status_line.hpp"
#include "rehearse/check/complaints.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/experiment/run.hpp"
#include "rehearse/files/temporary_folder.hpp"
#include "rehearse/files/write.hpp"
#include "rehearse/reward/saturating.hpp"

namespace rehearse::apps {
namespace {

std::string description(const StateVariable& state) {
  std::string text = with_unit(state.name, state.unit);
  if (state.kind == StateKind::angle) text += ", an angle";
  if (state.kind == StateKind::omitted) text += ", no input of models and policies";
  if (!state.rate.empty()) text += fmt::format(", whose rate is {}", state.rate);
  if (!state.parent.empty()) text += fmt::format(", carried by {}", state.parent);
  return text;
}

/// The actuation of an action in words: ", 0.2 s late".
std::string description(const Actuation& actuation, const std::string& unit) {
  std::string text;
  if (std::isfinite(actuation.max_rate))
    text += fmt::format(", changes by at most {:g} {}{}s", actuation.max_rate, unit, unit.empty() ? "1/" : "/");
  if (actuation.filter_s > 0) text += fmt::format(", through a low-pass of {:g} s", actuation.filter_s);
  if (actuation.delay_s > 0) text += fmt::format(", {:g} s late", actuation.delay_s);
  if (actuation.lag_s > 0) text += fmt::format(", followed with a lag of {:g} s", actuation.lag_s);
  return text;
}

std::span<const StateVariable> own_states(const Task& task) {
  return std::span(task.states).first(static_cast<std::size_t>(task.actuators().own_states()));
}

void print_lines(std::string_view indent, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) put("{}{}\n", indent, line);
}

/// summary: of the robot, with its condition of success.
void print_task(const scenario::Scenario& scenario, const std::string& summary, const scenario::Details& details) {
  const Task& task = scenario.task;
  put("{}: {} steps of {} s, {} s in all\n", scenario.name, task.horizon, task.dt_s, seconds(task.horizon, task.dt_s));
  if (!summary.empty()) put("  {}\n", summary);
  put("\nstates\n");
  for (std::size_t i = 0; i < own_states(task).size(); ++i) {
    const double start = task.start_mean(static_cast<Index>(i)), turns = std::abs(start) / (2 * std::numbers::pi);
    put("  {}; starts at {:.4g} ± {:.3g}\n", description(task.states[i]), start, task.start_std(static_cast<Index>(i)));
    if (task.states[i].kind == StateKind::angle && turns > 1)
      put("    that is {:.1f} turns; is it in degrees? Half a turn is pi = 3.1416\n", turns);
  }
  put("actions\n");
  for (const ActionVariable& action : task.actions)
    put("  {} from {:g} to {:g}{}\n", with_unit(action.name, action.unit), action.bounds.low, action.bounds.high,
        description(action.actuation, action.unit));
  if (task.memory > 0) put("what policies see of the last actions\n");
  for (const StateVariable& memory : std::span(task.states).last(static_cast<std::size_t>(task.memory)))
    put("  {}\n", description(memory));
  put("reward\n  {}{}\n",
      reward::closed_form(task.reward)
          ? "exp(-d²/2) of a distance d of features, which PILCO can learn with"
          : "a formula; PILCO needs distances that are sums of multiples of features, or exp(-d²/2) of such",
      task.cost ? "; PILCO takes no cost" : "");
  print_lines("  ", details.reward);
  if (task.ended) put("early end\n  {}\n", details.ended.empty() ? "the task says when" : details.ended);
  put("success\n  {}\n", task.solved ? "the task says when it is solved" : "nobody can say: there is no [success]");
  if (!task.limits.empty()) put("limits\n");
  for (const Limit& limit : task.limits)
    put("  {}{} at every step, in all but {:g} % of episodes\n", limit.name == limit.text ? "" : limit.name + ": ",
        limit.text, 100 * limit.risk);
  put("drawing\n  {}\n", scenario.drawing ? "bodies are drawn in reports" : "none: there is no [[body]]");
}

void print_parameters(const ParameterSpace& parameters) {
  std::vector<std::string> fixed;
  if (std::ranges::none_of(parameters.all(), &Parameter::tunable))
    put("    nothing to tune: gp-mi and mi learn no parameters of it\n");
  for (const Parameter& parameter : parameters.all()) {
    if (parameter.kind == Parameter::Kind::continuous)
      put("    {} = {:g}{}, learned in [{:g}, {:g}]\n", parameter.name, parameter.value, unit_text(parameter.unit),
          parameter.box.low, parameter.box.high);
    else if (parameter.kind == Parameter::Kind::discrete)
      put("    {} = {:g}{}, one of {}\n", parameter.name, parameter.value, unit_text(parameter.unit),
          fmt::join(parameter.choices, ", "));
    else
      fixed.push_back(fmt::format("{} = {:g}{}", parameter.name, parameter.value, unit_text(parameter.unit)));
  }
  if (!fixed.empty()) put("    fixed: {}\n", fmt::join(fixed, ", "));
}

/// The episodes that a search simulates, unless an option says otherwise; 0: not known.
Index usual_search(const experiment::Catalogue& catalogue) {
  const auto learner = catalogue.learner("gp-mi");
  if (!learner) return 0;
  const auto options = list_fields([&](FieldVisitor& v) { learner->fields(v); });
  const auto found = std::ranges::find(options, "search.race.max_evaluations", [](const auto& o) { return o.first; });
  return found == options.end() ? 0 : std::stoll(found->second);
}

/// Prints how fast a prior is, and how long a search takes whose time goes to it.
void print_speed(const check::PriorTried& tried, Index steps, Index rows_of_search) {
  const auto rows = static_cast<double>(rows_of_search);
  put("  {}: {:.2g} rows a second on one thread{}{}\n", tried.name, tried.rows_per_s,
      rows > 0 ? fmt::format("; a search of {:.2g} rows takes some {} on it alone, and many times as long with GPs",
                             rows, duration_text(rows / tried.rows_per_s))
               : "",
      tried.failed > 0 ? fmt::format("; {} of {} rows failed", tried.failed, steps) : "");
}

/// plays: the steps are its own, so it has no errors.
void print_prior(const scenario::NamedPrior& prior, const check::PriorTried& tried, const scenario::Scenario& scenario,
                 const check::Tried& all, const std::vector<std::string>& details, bool plays) {
  print_lines("    ", details);
  print_lines("    ", prior.lacks);
  print_lines("    ", tried.notes);
  print_parameters(prior.parameters);
  for (std::size_t i = 0; i < own_states(scenario.task).size(); ++i) {
    const auto s = static_cast<Index>(i);
    put("    {}: a step changes it by {:.3g}{}\n", scenario.task.states[i].name, all.change(s),
        plays                        ? ""
        : std::isnan(tried.error(s)) ? ", the prior has no prediction"
                                     : fmt::format(", the prior errs by {:.3g}", tried.error(s)));
  }
}

/// The ends before the horizon: ", 1 of 3 episodes ended early, 2 of 3 episodes broke the limit track".
std::string early_ends(const check::Tried& tried, const Task& task) {
  std::string text;
  if (tried.ended > 0) text += fmt::format(", {} of {} episodes ended early", tried.ended, tried.episodes);
  for (std::size_t l = 0; l < tried.limits.size(); ++l)
    if (tried.limits[l] > 0)
      text +=
          fmt::format(", {} of {} episodes broke the limit {}", tried.limits[l], tried.episodes, task.limits[l].name);
  return text;
}

/// The motion of an episode of random actions: the first trial of a learner that has no model yet.
void write_motion(const experiment::Catalogue& catalogue, const std::string& scenario, const std::string& share,
                  const std::string& page) {
  const files::TemporaryFolder folder;
  experiment::Spec spec;
  spec.scenario = scenario, spec.learner = "black-drops", spec.trials = 1;
  experiment::RunOptions options;
  options.stop = [] { return caught_signal() != 0; };
  experiment::start_run(catalogue, spec, folder.path() / "run", options);
  replay({.folder = (folder.path() / "run").string(),
          .trial = "1",
          .out = page,
          .headline = scenario + ": an episode of random actions"},
         share);
}

/// The example under another name; its head is about the new file.
std::string text_of_new(const std::string& name, const std::string& path) {
  std::string text = robot_template();
  text.replace(0, text.find("format = "),
               fmt::format("# A pendulum whose motor is too weak to lift it, to be made your robot. docs/own-robot.md "
                           "explains every key.\n# Try it:  {}\n#          {}\n",
                           command_line({"check", path}), command_line({"learn", path, "--learner", "gp-mi"})));
  const std::string old_name = "name = \"pendulum-file\"";
  return text.replace(text.find(old_name), old_name.size(), fmt::format("name = \"{}\"", name));
}

check::Tried tried_out(const scenario::Scenario& scenario) {
  return check::try_out(scenario, *evaluator_until_signal(1));
}

}  // namespace

int check(const experiment::Catalogue& built_in, const CheckArguments& arguments, const std::string& share) try {
  Violations violations;
  require_page(arguments.out, violations);
  violations.require(!arguments.out || !arguments.no_plant, "--out shows the plant's motion: leave --no-plant out");
  violations.throw_if_any();
  if (arguments.out) require_page_template(share);  // before the robot moves
  const experiment::Catalogue catalogue = with_robot(built_in, arguments.robot);
  const auto builder = catalogue.scenario_or_throw(catalogue.scenario_name(arguments.robot));
  scenario::Scenario scenario = builder->build();
  if (arguments.no_plant) scenario.make_plant = nullptr;
  const bool driven = static_cast<bool>(scenario.make_plant);
  if (arguments.out && !driven)
    throw InvalidInput(
        "--out: there is no [plant] whose motion it could show; in a copy, name the dynamics of a prior there");
  const scenario::Details details = builder->details();
  print_task(scenario, builder->summary(), details);
  if (scenario.require_ready)
    scenario.require_ready(driven ? scenario::PlantUse::driven : scenario::PlantUse::left_alone);
  // Ctrl-C ends an episode, so that a program is told to take the torque off the motors.
  const SignalWatch watch([] { return std::string("interrupted"); });
  const check::Tried tried = tried_out(scenario);
  if (arguments.no_plant)
    put("plant\n  left alone\n");
  else if (!driven)
    put("plant\n  none: there is no [plant], so its episodes are told\n");
  else if (!details.plant.empty())
    put("plant\n");
  print_lines("  ", details.plant);
  const bool anything = driven || !scenario.priors.empty();
  if (anything)
    put("priors, tried in {} steps of random actions{}{}\n", tried.steps,
        tried.played ? " (the first prior plays the robot)" : " on the plant", early_ends(tried, scenario.task));
  else
    put("priors\n");
  print_lines("  ", tried.notes);
  const Index rows_of_search = usual_search(catalogue) * scenario.task.horizon;
  for (std::size_t i = 0; i < tried.priors.size(); ++i) {
    print_speed(tried.priors[i], tried.steps, rows_of_search);
    print_prior(scenario.priors[i], tried.priors[i], scenario, tried,
                i < details.priors.size() ? std::vector{details.priors[i]} : std::vector<std::string>(),
                tried.played && i == 0);
  }
  for (const std::string& line : scenario.oracle_lacks) put("  oracle: not all of the plant. {}\n", line);
  if (scenario.priors.empty()) put("  none: learners without a prior can be used\n");
  const std::vector<std::string> faults = scenario.faults ? scenario.faults() : std::vector<std::string>();
  print_lines("  ", faults);
  const std::vector<std::string> complaints = check::complaints(tried);
  if (arguments.out && !tried.end) write_motion(catalogue, scenario.name, share, *arguments.out);
  if (!complaints.empty()) throw InvalidInput(fmt::format("{}", fmt::join(complaints, "\n")));
  const bool noted = !faults.empty() || check::has_notes(tried);
  put("\n{}; to learn: {}{}\n",
      !anything ? "the task is understood; nothing was tried, as there is neither a plant nor a prior"
      : noted   ? "nothing is broken, but see what is noted above"
                : "all is well",
      command_line({"learn", arguments.robot, "--learner", scenario.priors.empty() ? "black-drops" : "gp-mi"}),
      driven || arguments.no_plant ? "" : " --trials 0");
  return kSuccess;
} catch (const Interrupted&) {
  complain("interrupted");
  return exit_code_of_signal();
}

int make_new(const experiment::Catalogue& catalogue, const NewArguments& arguments) {
  const std::string ending = ".toml";
  const bool ends = arguments.name.ends_with(ending);
  const std::string name = arguments.name.substr(0, arguments.name.size() - (ends ? ending.size() : 0));
  if (!is_word(name))
    throw InvalidInput(
        fmt::format("a robot cannot be called '{}': its name must be of letters, digits, - and _", name));
  const std::filesystem::path path = name + ending;
  const std::string text = text_of_new(name, path.string());
  static_cast<void>(catalogue.with_robot(text, path.string(), ""));  // the name may be another's
  if (std::filesystem::exists(path))
    throw InvalidInput(fmt::format("{} exists, and is not overwritten", path.string()));
  if (const std::string why = why_not_writable(path); !why.empty()) throw InvalidInput(why);
  files::write_shared_file(path, text);
  put("{} is a pendulum, to be made your robot. Say what it is, then: {}\n", path.string(),
      command_line({"check", path.string()}));
  return kSuccess;
}

}  // namespace rehearse::apps
