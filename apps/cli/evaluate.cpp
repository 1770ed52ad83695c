#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
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
#include "rehearse/experiment/past_run.hpp"
#include "rehearse/experiment/prepared_evaluation.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/statistics/quantiles.hpp"

namespace rehearse::apps {
namespace {

namespace fs = std::filesystem;

using experiment::EvaluationRequest, experiment::PreparedEvaluation, experiment::Summary;

/// The arguments as what they mean, as far as they are right.
struct Wanted {
  EvaluationRequest request;
  bool knows_policy = true;
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

Wanted wanted(const EvaluateArguments& arguments, Violations& violations) {
  Wanted wanted{.request = {.folder = arguments.folder}, .table = table_of(arguments)};
  EvaluationRequest& request = wanted.request;
  request.trial = trial_of(arguments.trial, violations);
  if (arguments.policy) {
    violations.attempt([&] { request.policy = files::read_file(*arguments.policy, files::Links::follow); });
    request.policy_source = *arguments.policy;
  }
  violations.require(!arguments.policy || !arguments.trial, "--trial and --policy name two policies");
  wanted.knows_policy = violations.empty();
  const Fields fields = [&](FieldVisitor& v) {
    request.plan.fields(v);
    v.number("seconds", request.plan.seconds, "length of an episode [s]", above(0));
  };
  set_text(fields, "episodes", arguments.episodes, violations);
  set_text(fields, "seconds", arguments.seconds, violations);
  set_text(fields, "seed", arguments.seed, violations);
  request.seed_of_run = !arguments.seed;
  wanted.threads = threads_of(arguments.threads, violations);
  request.settings = settings_of(arguments.set, violations);
  if (arguments.out) violations.attempt([&] { check_output(wanted.table); });
  return wanted;
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
    put("all returns are equal; where the plant has no random start and no noise, one episode tells as much\n");
}

/// Prints the rate solved at the end of the episode by changed parameter; the median return if the task has no test of
/// success.
void print_robustness(const std::vector<experiment::Changed>& all) {
  const bool can_say =
      std::ranges::any_of(all, [](const auto& each) { return each.summary.solved_at_end.has_value(); });
  put("{} by the factor of one parameter at a time\n{:12}", can_say ? "solved at the end, in %," : "median return", "");
  for (const double factor : experiment::kFactors) put("{:>9g}", factor);
  for (auto each = all.begin(); each != all.end();) {
    const std::string& parameter = each->parameter;
    put("\n{:12}", parameter);
    for (const double factor : experiment::kFactors) {
      if (each == all.end() || each->parameter != parameter || each->factor != factor) {
        put("{:>9}", "-");  // beyond the bounds of its option
        continue;
      }
      if (each->failure.empty())
        put("{:>9.4g}",
            can_say ? 100 * each->summary.solved_at_end->value() : statistics::median(each->summary.returns));
      else
        put("{:>9}", "fails");
      ++each;
    }
  }
  put("\n");
  for (const std::string& line : experiment::robustness_failures(all)) put("  {}\n", line);
}

/// An older file of this name is kept under another one.
void write_table(const OutputFile& table, const std::string& text) {
  const std::string path = table.path.string();
  if (const auto older = write_beside_older(table, text)) put("{} is kept as {}\n", path, older->string());
  put("{} has the numbers\n", path);
}

/// An evaluation that is ready to run, and the table that it writes.
struct Work {
  PreparedEvaluation prepared;
  OutputFile table;
  std::shared_ptr<const Evaluator> evaluator;

  const experiment::Resolved& resolved() const { return prepared.resolved; }
  double task_s() const { return resolved().scenario.task.episode_s(); }
  double episode_s() const { return prepared.about().seconds; }
};

/// A run keeps its robot, so a plant that the file gets later is of use in another run only.
void require_robot(const experiment::PastRun& run) {
  if (experiment::has_robot(run.resolved)) return;
  const std::string way =
      command_line({"learn", "COPY.toml", "--learner", run.resolved.spec.learner, "--trials", "0", "--out", "OTHER"});
  throw InvalidInput(fmt::format("{}. A copy of its file with [plant], a simulator, has one: {}; then: {}",
                                 experiment::why_no_robot(run.resolved), way,
                                 command_line({"evaluate", "OTHER", "--policy", "FILE.json"})));
}

Work prepared(const experiment::Catalogue& catalogue, const EvaluateArguments& arguments) {
  Violations violations;
  Wanted asked = wanted(arguments, violations);
  std::optional<experiment::PastRun> run;
  const bool has_robot = violations.attempt([&] {
    run = experiment::read_run(catalogue, asked.request.folder);
    require_robot(*run);
  });
  if (has_robot && !arguments.out)  // now, not after hours of episodes
    violations.attempt([&] { check_output(asked.table); });
  if (!has_robot || !asked.knows_policy) violations.throw_if_any();
  return {experiment::prepare_evaluation(*run, std::move(asked.request), std::move(violations)), std::move(asked.table),
          evaluator_until_signal(static_cast<int>(asked.threads))};
}

void announce(const Work& work, const EvaluateArguments& arguments) {
  const auto& [request, policy, of_run, resolved, told] = work.prepared;
  const std::string settings = work.prepared.about().settings;
  const std::string whose = arguments.policy ? *arguments.policy : fmt::format("trial {}", policy.learned.trial);
  const auto& earned = policy.total_reward;
  if (const prior::Prior* prior = resolved.stand_in())
    put("there is no [plant]: the prior {} plays the robot, as it was identified, without the GPs\n", prior->name);
  else if (told)
    put("the plant plays the robot: a simulator, not the robot that was told of\n");
  put("the policy of {}{}: {} of {:g} s, seed {}{}{}\n", whose, earned ? fmt::format(" (return {:.4g})", *earned) : "",
      counted(request.plan.episodes, "episode"), work.episode_s(), request.plan.seed, settings.empty() ? "" : ", ",
      settings);
}

/// Ways to policies that hold longer, where this one does not and the learner has some that it did not take.
void advise(const Work& work, const Summary& summary) {
  if (!summary.solved_at_end || summary.solved_at_end->count >= summary.solved->count) return;
  const auto leaves_out = [&](const std::string& option, const std::string& value) {
    const learners::OptionTexts& options = work.resolved().spec.options;
    return std::ranges::find(options, std::pair(option, value)) != options.end();
  };
  std::vector<std::string> ways;
  if (leaves_out("learner.search.hand_over", "false")) ways.emplace_back("search.hand_over=true");
  if (leaves_out("learner.search.extra_s", "0")) ways.emplace_back("search.extra_s=SECONDS");
  if (!ways.empty()) put("to learn a policy that holds longer: --set {} (docs/evaluate.md)\n", fmt::join(ways, " or "));
}

void evaluate_episodes(const Work& work) {
  const auto outcomes = experiment::evaluate(work.prepared, *work.evaluator);
  const Summary summary = experiment::summary_of(outcomes);
  print_summary(summary, work.task_s(), work.episode_s());
  advise(work, summary);
  write_table(work.table, experiment::evaluation_csv(outcomes, work.prepared.about()));
}

void evaluate_robustness(const Work& work) {
  const auto all = experiment::robustness(work.prepared, *work.evaluator);
  print_robustness(all);
  write_table(work.table, experiment::robustness_csv(all, work.prepared.about()));
}

}  // namespace

int evaluate(const experiment::Catalogue& catalogue, const EvaluateArguments& arguments) try {
  const Work work = prepared(catalogue, arguments);
  announce(work, arguments);
  const SignalWatch watch([] { return std::string("interrupted; nothing is written"); });
  (arguments.robustness ? evaluate_robustness : evaluate_episodes)(work);
  return kSuccess;
} catch (const Interrupted&) {
  complain("interrupted; nothing is written");
  return exit_code_of_signal();
}

}  // namespace rehearse::apps
