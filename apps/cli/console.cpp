#include "apps/cli/console.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/cli/limit_text.hpp"
#include "apps/cli/program.hpp"
#include "rehearse/experiment/priors.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/experiment/tables.hpp"

namespace rehearse::apps {
namespace {

using Seconds = std::chrono::duration<double>;

std::string verdict(const std::optional<bool>& solved) { return !solved ? "" : *solved ? "  solved" : "  not solved"; }

/// The limits in one word, the one that is nearest to what it allows, and those that the trial broke.
std::string safety(const std::vector<experiment::LimitRecord>& limits) {
  if (limits.empty()) return "";
  const auto nearness = [](const experiment::LimitRecord& l) { return l.predicted.value_or(1) / l.allowed; };
  const auto& nearest = *std::ranges::max_element(limits, {}, nearness);
  std::string text = "  risk not known";
  if (nearest.predicted)
    text = fmt::format("  {}: {}, risk {}",
                       std::ranges::all_of(limits, &experiment::LimitRecord::safe) ? "safe" : "not safe", nearest.limit,
                       risk_text(nearest));
  if (const std::string broken = broken_text(limits); !broken.empty()) text += "  " + broken;
  return text;
}

}  // namespace

void Console::started(const experiment::Resolved& resolved, const std::filesystem::path& folder, Index done) {
  const experiment::Spec& spec = resolved.spec;
  trials_ = spec.trials;
  says_when_solved_ = resolved.scenario.task.solved != nullptr;
  done_ = done_before_ = done;
  priors_ = spec.prior;
  phi_names_ = experiment::tunable_names(resolved.prior);
  faults_ = resolved.scenario.faults;
  begin_ = trial_begin_ = phase_begin_ = Clock::now();
  if (begins_ == Begin::silent) return;
  const std::string prior = spec.prior.empty() ? "" : fmt::format(" from prior {}", spec.prior);
  const Task& task = resolved.scenario.task;
  const std::string trials =
      spec.trials == 0 ? "trials" : (spec.until_solved ? "up to " : "") + counted(spec.trials, "trial");
  line_.print(fmt::format("{} learned by {}{}, seed {}: {} of {} s in {}", spec.scenario, spec.learner, prior,
                          spec.seed, trials, seconds(task.horizon, task.dt_s), folder.string()));
  for (const std::string& warning : resolved.warnings) line_.print("warning: " + warning);
  if (done > 0) line_.print(fmt::format("continuing after trial {}", done));
}

/// "3/10", or "3" where nobody said how many there are to be.
std::string Console::number(Index trial) const {
  return trials_ >= trial ? fmt::format("{:>2}/{}", trial, trials_) : fmt::format("{}", trial);
}

void Console::look() {
  constexpr auto kPeriod = std::chrono::seconds(1);
  if (std::this_thread::get_id() != owner_ || Clock::now() < next_look_) return;
  next_look_ = Clock::now() + kPeriod;
  say_first_faults();
  show_progress();
}

void Console::say_first_faults() {
  const std::vector<std::string> faults = faults_ ? faults_() : std::vector<std::string>();
  if (faults.empty()) return;
  for (const std::string& fault : faults) line_.print("warning: " + fault);
  faults_ = nullptr;
}

void Console::clear_line() {
  progress_ = {};
  line_.clear();
}

void Console::progress(Index trial, const Progress& progress) {
  const bool begins = progress.phase != progress_.phase || progress.done < progress_.done;  // or a further search
  if (begins) phase_begin_ = Clock::now();
  trial_ = trial, progress_ = progress;
  look();
  show_progress();
}

void Console::show_progress() {
  if (progress_.phase.empty() || !line_.is_due()) return;
  std::string line = fmt::format("trial {}  {}", number(trial_), progress_.phase);
  if (progress_.done > 0)
    line += fmt::format(" {:.0f} %{}", 100 * progress_.done, time_left());
  else
    line += fmt::format(", {}", duration_text(Seconds(Clock::now() - phase_begin_).count()));
  if (progress_.rollouts > 0 && std::isfinite(progress_.best))
    line += fmt::format("  predicted {:.3f}", progress_.best);
  if (progress_.rollouts > 0) line += fmt::format("  {:.0f} rollouts/s", progress_.rollouts_per_s);
  line_.show(line);
}

/// Trials are taken to last as long as those before, unless this phase alone takes longer; before there are any, only
/// the phase is known.
std::string Console::time_left() const {
  const auto now = Clock::now();
  const double in_phase = Seconds(now - phase_begin_).count(), in_trial = Seconds(now - trial_begin_).count();
  double left = progress_.done < 0.02 ? 0 : in_phase * (1 / progress_.done - 1);
  if (done_ > done_before_ && trials_ > done_) {
    const double per_trial = Seconds(trial_begin_ - begin_).count() / static_cast<double>(done_ - done_before_);
    left = std::max(left, per_trial - in_trial) + static_cast<double>(trials_ - done_ - 1) * per_trial;
  }
  return left > 0 ? fmt::format(", {} left", duration_text(left)) : "";
}

void Console::trial_done(const experiment::TrialRecord& record) {
  done_ = record.trial;
  trial_begin_ = phase_begin_ = Clock::now();
  progress_ = {};
  std::string line = fmt::format("trial {}  return {:8.3f}", number(record.trial), record.total_reward);
  if (record.predicted_return) line += fmt::format("  predicted {:8.3f}", *record.predicted_return);
  line += verdict(record.solved) + safety(record.limits);
  for (std::size_t i = 0; i < std::min(phi_names_.size(), record.phi.size()); ++i)
    line += fmt::format("  {} {}", phi_names_[i], experiment::phi_text(priors_, i, record.phi[i]));
  line_.print(line);
  for (const std::string& note : record.notes) line_.print("  " + note);
}

void Console::interrupted() {
  clear_line();
  say_first_faults();
}

void Console::finished(const experiment::RunResult& result) {
  for (const std::string& warning : result.warnings) line_.print(warning);
  const std::string folder = result.folder.string();
  if (result.trials == 0)
    return line_.print(fmt::format("{} is ready; the first policy: {}, or logs before it: {}", folder,
                                   command_line({"ask", folder}), command_line({"tell", folder, "LOG.csv…"})));
  const std::string solved = result.solved_at
                                 ? fmt::format("solved at trial {}", *result.solved_at)
                                 : (says_when_solved_ ? "not solved in " : "") + counted(result.trials, "trial");
  line_.print(fmt::format("{}, best return {:.3f}, in {}; its page: {}", solved, result.best_return, folder,
                          command_line({"report", folder})));
}

}  // namespace rehearse::apps
