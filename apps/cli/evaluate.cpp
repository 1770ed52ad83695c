#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/cli/arguments.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/complain.hpp"
#include "apps/cli/output_file.hpp"
#include "apps/cli/program.hpp"
#include "apps/cli/signals.hpp"
#include "apps/cli/status_line.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/experiment/given_policy.hpp"
#include "rehearse/experiment/past_run.hpp"
#include "rehearse/experiment/robustness.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/statistics/quantiles.hpp"

namespace rehearse::apps {
namespace {

namespace fs = std::filesystem;

using experiment::GivenPolicy, experiment::PastRun, experiment::Summary, experiment::TrialRecord;
using Settings = std::vector<std::pair<std::string, std::string>>;

/// The arguments as what they mean.
struct Wanted {
  std::optional<Index> trial;
  experiment::EvaluationPlan plan;
  std::optional<Index> seed;
  Settings settings;
  Index threads = 0;
  OutputFile table;
};

OutputFile table_of(const EvaluateArguments& arguments) {
  const fs::path beside = fs::path(arguments.folder) / (arguments.robustness ? "robustness.csv" : "evaluation.csv");
  return {.path = arguments.out ? fs::path(*arguments.out) : beside,
          .kind = "table of Rehearse",
          .option = "--out FILE.csv",
          .is_ours = [](std::string_view text) {
            return text.starts_with("trial,settings,seed,") || text.starts_with("parameter,factor,");
          }};
}

Wanted wanted(const EvaluateArguments& arguments) {
  Violations violations;
  Wanted wanted;
  wanted.trial = trial_of(arguments.trial, violations);
  const Fields fields = [&](FieldVisitor& v) {
    wanted.plan.fields(v);
    v.number("seconds", wanted.plan.seconds, "length of an episode [s]", above(0));
  };
  set_text(fields, "episodes", arguments.episodes, violations);
  set_text(fields, "seconds", arguments.seconds, violations);
  set_text(fields, "seed", arguments.seed, violations);
  wanted.threads = threads_of(arguments.threads, violations);
  wanted.settings = settings_of(arguments.set, violations);
  violations.require(!arguments.policy || !arguments.trial, "--trial and --policy name two policies");
  wanted.table = table_of(arguments);
  try {
    if (arguments.out) check_output(wanted.table);
  } catch (const InvalidInput& error) {
    violations.add(error);
  }
  violations.throw_if_any();
  if (arguments.seed) wanted.seed = wanted.plan.seed;
  return wanted;
}

std::string settings_text(const Settings& settings) {
  std::vector<std::string> parts;
  for (const auto& [key, value] : settings) parts.push_back(key + "=" + value);
  return fmt::format("{}", fmt::join(parts, " "));
}

GivenPolicy policy_wanted(const EvaluateArguments& arguments, const Wanted& wanted, const PastRun& run) {
  if (!arguments.policy) {
    const TrialRecord& trial = run.trial(wanted.trial);
    const bool done = trial.trial <= run.history.done();
    return {{policy_of(trial, run.resolved.scenario), trial.theta, trial.trial},
            done ? std::optional(trial.total_reward) : std::nullopt};
  }
  return experiment::given_policy(files::read_file(*arguments.policy, files::Links::follow), *arguments.policy,
                                  run.resolved.scenario);
}

std::string rate_text(const statistics::Rate& rate) {
  return fmt::format("{} of {} episodes, {:.3g} % (95 % interval {:.3g} to {:.3g} %)", rate.count, rate.of,
                     100 * rate.value(), 100 * rate.interval.low, 100 * rate.interval.high);
}

void print_summary(const Summary& summary, double task_s, double episode_s) {
  if (!summary.solved) put("solved         the task does not say what that is\n");
  if (summary.solved) put("solved at {:g} s  {}\n", task_s, rate_text(*summary.solved));
  if (summary.solved && episode_s > task_s) put("solved at {:g} s  {}\n", episode_s, rate_text(*summary.solved_at_end));
  put("ended early    {}\n", rate_text(summary.ended));
  for (const auto& [limit, rate] : summary.broke) put("{:14} {}\n", "broke " + limit, rate_text(rate));
  const auto [min, low, median, high, max] = statistics::five_numbers(summary.returns);
  put("return         median {:.4g}, quartiles {:.4g} and {:.4g}, all from {:.4g} to {:.4g}\n", median, low, high, min,
      max);
  if (min == max && summary.returns.size() > 1)
    put("all episodes are alike: this plant has no random start and no noise, so one tells as much\n");
}

/// Prints the rate solved at the end of the episode by changed parameter; the median return if the task has no test of
/// success.
void print_robustness(const std::vector<experiment::Changed>& all) {
  const bool can_say = all.front().summary.solved_at_end.has_value();
  put("{} by the factor of one parameter at a time\n{:12}", can_say ? "solved at the end, in %," : "median return", "");
  for (const double factor : experiment::kFactors) put("{:>9g}", factor);
  for (const experiment::Changed& each : all) {
    if (each.factor == experiment::kFactors.front()) put("\n{:12}", each.parameter);
    const double value = can_say ? 100 * each.summary.solved_at_end->value() : statistics::median(each.summary.returns);
    put("{:>9.4g}", value);
  }
  put("\n");
}

/// An older file of this name is kept under another one.
void write_table(const OutputFile& table, const std::string& text) {
  const std::string path = table.path.string();
  if (const auto older = write_beside_older(table, text)) put("{} is kept as {}\n", path, older->string());
  put("{} has the numbers\n", path);
}

/// A policy, what is set, and how it is evaluated.
struct Work {
  const experiment::Catalogue& catalogue;
  fs::path folder;
  Wanted wanted;
  GivenPolicy policy;
  experiment::Resolved resolved;
  bool told = false;  // the run's trials were on a robot that is not its plant
  std::shared_ptr<const Evaluator> evaluator;

  const Task& task() const { return resolved.scenario.task; }
  double episode_s() const { return seconds(wanted.plan.steps(task()), task().dt_s); }
  experiment::EvaluationAbout about() const {
    return {policy.learned.trial, settings_text(wanted.settings), wanted.plan.seed, episode_s()};
  }
};

/// A run keeps its robot, so a plant that the file gets later is of use in another run only.
void require_robot(const PastRun& run) {
  if (experiment::has_robot(run.resolved)) return;
  const std::string way =
      command_line({"learn", "COPY.toml", "--learner", run.resolved.spec.learner, "--trials", "0", "--out", "OTHER"});
  throw InvalidInput(fmt::format(
      "{} has no plant that episodes could run on, and the run has no prior that could play it, or several. "
      "A copy of its file with [plant], a simulator, has one: {}; then: {}",
      run.resolved.scenario.name, way, command_line({"evaluate", "OTHER", "--policy", "FILE.json"})));
}

Work prepared(const experiment::Catalogue& catalogue, const EvaluateArguments& arguments) {
  Wanted wanted = apps::wanted(arguments);
  const fs::path folder = arguments.folder;
  const PastRun run = experiment::read_run(catalogue, folder);
  check_output(wanted.table);  // not after hours of episodes
  require_robot(run);
  GivenPolicy policy = policy_wanted(arguments, wanted, run);
  wanted.settings = run.as_identified(wanted.settings);
  experiment::Resolved resolved = experiment::read_run(catalogue, folder, wanted.settings).resolved;
  wanted.plan.seed = wanted.seed.value_or(resolved.spec.seed);
  const std::shared_ptr<const Evaluator> threads = make_thread_evaluator(static_cast<int>(wanted.threads));
  return {catalogue,
          folder,
          std::move(wanted),
          std::move(policy),
          std::move(resolved),
          experiment::was_told(run.history),
          make_stoppable(threads, [] { return caught_signal() != 0; })};
}

void announce(const Work& work, const EvaluateArguments& arguments) {
  const std::string settings = settings_text(work.wanted.settings);
  const std::string whose = arguments.policy ? *arguments.policy : fmt::format("trial {}", work.policy.learned.trial);
  const auto& earned = work.policy.total_reward;
  if (const prior::Prior* prior = work.resolved.stand_in())
    put("there is no [plant]: the prior {} plays the robot, as it was identified, without the GPs\n", prior->name);
  else if (work.told)
    put("the plant plays the robot: a simulator, not the robot that was told of\n");
  put("the policy of {}{}: {} of {:g} s, seed {}{}{}\n", whose, earned ? fmt::format(" (return {:.4g})", *earned) : "",
      counted(work.wanted.plan.episodes, "episode"), work.episode_s(), work.wanted.plan.seed,
      settings.empty() ? "" : ", ", settings);
}

/// Ways to policies that hold longer, where this one does not and the learner has some that it did not take.
void advise(const Work& work, const Summary& summary) {
  if (!summary.solved_at_end || summary.solved_at_end->count >= summary.solved->count) return;
  const auto leaves_out = [&](const std::string& option, const std::string& value) {
    const Settings& options = work.resolved.spec.options;
    return std::ranges::find(options, std::pair(option, value)) != options.end();
  };
  std::vector<std::string> ways;
  if (leaves_out("learner.search.hand_over", "false")) ways.emplace_back("search.hand_over=true");
  if (leaves_out("learner.search.extra_s", "0")) ways.emplace_back("search.extra_s=SECONDS");
  if (!ways.empty()) put("to learn a policy that holds longer: --set {} (docs/evaluate.md)\n", fmt::join(ways, " or "));
}

void evaluate_episodes(const Work& work) {
  const auto outcomes = experiment::evaluate(work.resolved, work.policy.learned, work.wanted.plan, *work.evaluator);
  const Summary summary = experiment::summary_of(outcomes);
  print_summary(summary, work.task().episode_s(), work.episode_s());
  advise(work, summary);
  write_table(work.wanted.table, experiment::evaluation_csv(outcomes, work.about()));
}

void evaluate_robustness(const Work& work) {
  const auto changed = [&](const std::string& key, const std::string& value) {
    Settings settings = work.wanted.settings;
    settings.emplace_back(key, value);
    return experiment::read_run(work.catalogue, work.folder, settings).resolved;
  };
  const auto all =
      experiment::robustness(changed, work.resolved, work.policy.learned, work.wanted.plan, *work.evaluator);
  print_robustness(all);
  write_table(work.wanted.table, experiment::robustness_csv(all, work.about()));
}

}  // namespace

int evaluate(const experiment::Catalogue& catalogue, const EvaluateArguments& arguments) try {
  const Work work = prepared(catalogue, arguments);
  if (work.resolved.scenario.require_ready) work.resolved.scenario.require_ready(scenario::PlantUse::driven);
  announce(work, arguments);
  const SignalWatch watch([] { return std::string("interrupted; nothing is written"); });
  (arguments.robustness ? evaluate_robustness : evaluate_episodes)(work);
  return kSuccess;
} catch (const Interrupted&) {
  complain("interrupted; nothing is written");
  return exit_code_of_signal();
}

}  // namespace rehearse::apps
