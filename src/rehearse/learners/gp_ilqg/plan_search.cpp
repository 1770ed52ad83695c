#include "rehearse/learners/gp_ilqg/plan_search.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <thread>

#include "rehearse/learners/gp_ilqg/forward_pass.hpp"
#include "rehearse/lqr/hold.hpp"
#include "rehearse/policy/schedule.hpp"
#include "rehearse/rollout/simulate.hpp"

namespace rehearse::learners::gp_ilqg {
namespace {

constexpr double kSamePromise = 1e-3;  // relative
constexpr double kShaken = 0.01;       // of half an action's range, by the noise of measurements: a gain is too large
constexpr double kSofter = 10, kSoftest = 100;  // of the action cost

using Stages = std::vector<policy::FeedbackStage>;

/// A plan's simulated episodes in two numbers.
struct Judged {
  double mean = -kInf;
  double solving = 0;  // fraction of the episodes that it solves
};

/// How far plans are, as a fraction of the iterations that they may take. Reports on the thread that made it alone.
class PlanProgress {
 public:
  explicit PlanProgress(const ProgressSink& sink) : sink_(sink) {}

  void begin(const char* phase, Index iterations) {
    phase_ = phase;
    total_ = std::max<Index>(1, iterations);
    done_ = 0;
    report();
  }

  void improved(Index iterations) {
    done_ += iterations;
    if (std::this_thread::get_id() == thread_) report();
  }

 private:
  void report() const {
    if (sink_) sink_({.phase = phase_, .done = static_cast<double>(done_) / static_cast<double>(total_), .best = kNaN});
  }

  const ProgressSink& sink_;
  const std::thread::id thread_ = std::this_thread::get_id();
  const char* phase_ = "";
  Index total_ = 1;
  std::atomic<Index> done_ = 0;
};

class Search {
 public:
  Search(const lqr::Problem& problem, const PlanSearch& search, StreamKey stream, const ProgressSink& sink)
      : problem_(problem), search_(search), stream_(stream), progress_(sink) {}

  std::optional<FoundPlan> run(const std::optional<Vector>& last) {
    std::vector<Stages> from = starts(last);
    const Index to_end = (search_.hold ? 2 : 1) * search_.iterations;  // of each plan
    const Index finalists = search_.finalists + (last ? 1 : 0);
    progress_.begin("plans", static_cast<Index>(from.size()) * search_.first_iterations + finalists * to_end);
    const bool by_logarithm = search_.cost != PlanSearch::Cost::linear && has_logarithm(from);
    std::vector<Plan> plans =
        improved(std::move(from), options(by_logarithm, search_.first_costs, search_.first_iterations));
    keep_best(plans);
    if (plans.empty()) return std::nullopt;
    if (last) {  // as it is, too: what is good need not be found again
      std::vector<Plan> as_it_is = improved({policy::to_stages(problem_.task, *last)}, options(false, 1, 0));
      std::move(as_it_is.begin(), as_it_is.end(), std::back_inserter(plans));
    }
    const bool to_linear = search_.cost != PlanSearch::Cost::logarithmic;
    PlanOptions further = options(by_logarithm && !to_linear, 1, search_.iterations);
    std::vector<Plan> finals = finished(plans, further), softer = finals;
    for (double factor = kSofter; factor <= kSoftest && are_shaken(softer); factor *= kSofter) {
      progress_.begin("softer plans", static_cast<Index>(plans.size()) * to_end);
      further.cost.action_cost = factor * search_.action_cost;
      softer = finished(plans, further);
      finals.insert(finals.end(), softer.begin(), softer.end());
    }
    return chosen(finals);
  }

 private:
  PlanOptions options(bool logarithmic, double task_costs, Index iterations) const {
    return {.cost = {.scale = logarithmic ? lqr::CostScale::logarithmic : lqr::CostScale::linear,
                     .action_cost = search_.action_cost,
                     .task_costs = task_costs},
            .uncertainty = search_.uncertainty,
            .iterations = iterations};
  }

  std::vector<Stages> starts(const std::optional<Vector>& last) const {
    std::vector<Stages> all;
    if (last) all.push_back(policy::to_stages(problem_.task, *last));
    Task planned = problem_.task;
    planned.horizon = steps_to_plan(problem_.task, search_);
    for (ActionVariable& action : planned.actions) {
      const double middle = 0.5 * (action.bounds.low + action.bounds.high);
      action.bounds = {middle + search_.start_size * (action.bounds.low - middle),
                       middle + search_.start_size * (action.bounds.high - middle)};
    }
    for (Index i = 0; i < search_.starts; ++i) {
      StreamKey key = stream_;
      key.descent = static_cast<std::uint64_t>(i);
      const Vector actions =
          policy::random_schedule(planned, policy::RandomActions::uniform, search_.start_hold_s, key);
      all.push_back(policy::open_loop(problem_.task, actions.reshaped(planned.horizon, problem_.task.action_size())));
    }
    return all;
  }

  /// True if all rewards from these starts are positive.
  bool has_logarithm(const std::vector<Stages>& from) const {
    const lqr::StepCosts costs(problem_.task, {.action_cost = 0, .task_costs = 0});
    const ForwardPass forward(problem_, costs, nullptr);
    double least = kInf;
    for (const Trajectory& trajectory : forward.follow(from)) {
      Vector lost(trajectory.steps);
      costs.evaluate(trajectory.rows(costs.columns()), trajectory.times(problem_.task), lost);
      if (trajectory.steps > 0) least = std::min(least, -lost.maxCoeff());
    }
    return least > 0 && least < kInf;
  }

  std::vector<Plan> improved(std::vector<Stages> from, const PlanOptions& options, const lqr::Hold* hold = nullptr) {
    std::vector<Plan> plans(from.size());
    problem_.evaluator.for_each(static_cast<Index>(from.size()), [&](Index i) {
      const auto k = static_cast<std::size_t>(i);
      plans[k] = improve(problem_, options, std::move(from[k]), hold);
      progress_.improved(options.iterations);
    });
    std::erase_if(plans, [](const Plan& plan) { return !std::isfinite(plan.cost); });
    return plans;
  }

  /// Improved to the end, and again towards a hold.
  std::vector<Plan> finished(const std::vector<Plan>& plans, const PlanOptions& further) {
    std::vector<Plan> finals = improved(stages_of(plans), further);
    if (const auto hold = search_.hold ? best_hold(finals, further) : std::nullopt)
      for (Plan& plan : improved(stages_of(finals), further, &*hold)) finals.push_back(std::move(plan));
    return finals;
  }

  /// True if feedback passes so much of the measurements' noise on to the actions that plans with less of it may earn
  /// more. The passes, which know no such noise, cannot tell.
  bool are_shaken(const std::vector<Plan>& plans) const {
    const Vector noise = problem_.model.measurement_std();
    if (!search_.soften || noise.size() == 0) return false;
    const Vector half = lqr::StepCosts(problem_.task, {}).half_ranges();
    return std::ranges::any_of(plans, [&](const Plan& plan) {
      Vector variance = Vector::Zero(half.size());
      for (const policy::FeedbackStage& stage : plan.stages)
        variance += (stage.gain * noise.asDiagonal()).rowwise().squaredNorm();
      const Vector shaken = (variance / static_cast<double>(plan.stages.size())).cwiseSqrt();
      return (shaken.array() > kShaken * half.array()).any();
    });
  }

  static std::vector<Stages> stages_of(const std::vector<Plan>& plans) {
    std::vector<Stages> all;
    for (const Plan& plan : plans) all.push_back(plan.stages);
    return all;
  }

  /// Plans that come to the same, mirrored ones for instance, count as one.
  void keep_best(std::vector<Plan>& plans) const {
    std::stable_sort(plans.begin(), plans.end(), [](const Plan& a, const Plan& b) { return a.promise > b.promise; });
    const auto same = [](const Plan& a, const Plan& b) {
      return std::abs(a.promise - b.promise) <= kSamePromise * std::abs(a.promise);
    };
    plans.erase(std::unique(plans.begin(), plans.end(), same), plans.end());
    plans.resize(std::min(plans.size(), static_cast<std::size_t>(search_.finalists)));
  }

  /// The cheapest of those near the cheapest state of each plan.
  std::optional<lqr::Hold> best_hold(const std::vector<Plan>& plans, const PlanOptions& options) const {
    const lqr::StepCosts costs(problem_.task, options.cost);
    const double end_s = static_cast<double>(steps_to_plan(problem_.task, search_)) * problem_.task.dt_s;
    const auto most = static_cast<Index>(plans.size());
    Matrix states(most, problem_.task.state_size()), actions(most, problem_.task.action_size());
    Index rows = 0;
    for (const Plan& plan : plans) {
      if (plan.steps == 0) continue;
      const Matrix taken = actions_of(plan);
      Index cheapest = 0;
      costs.of_staying(plan.states.topRows(plan.steps), taken, end_s).minCoeff(&cheapest);
      states.row(rows) = plan.states.row(cheapest);
      actions.row(rows++) = taken.row(cheapest);
    }
    return lqr::find_cheapest_hold(problem_, costs, states.topRows(rows), actions.topRows(rows), end_s);
  }

  Matrix actions_of(const Plan& plan) const {
    Matrix actions(plan.steps, problem_.task.action_size());
    for (Index t = 0; t < plan.steps; ++t) actions.row(t) = plan.stages[static_cast<std::size_t>(t)].action.transpose();
    return actions;
  }

  std::optional<FoundPlan> chosen(const std::vector<Plan>& plans) {
    if (plans.empty()) return std::nullopt;
    std::vector<Judged> judged;
    for (const Plan& plan : plans) judged.push_back(judge(plan));
    double highest = -kInf;
    for (const Judged& plan : judged) highest = std::max(highest, plan.mean);
    std::size_t best = 0;
    for (std::size_t i = 0; i < judged.size(); ++i)
      if (is_better(judged[i], judged[best], highest)) best = i;
    return FoundPlan{policy::to_theta(plans[best].stages), judged[best].mean, rollouts_, failed_};
  }

  /// The better of two is nearer the highest return; where both are near, it solves the task more often.
  bool is_better(const Judged& a, const Judged& b, double highest) const {
    const auto near = [&](const Judged& plan) { return plan.mean >= highest - search_.tolerance * std::abs(highest); };
    if (near(a) != near(b)) return near(a);
    if (near(a) && a.solving != b.solving) return a.solving > b.solving;
    return a.mean > b.mean;
  }

  Judged judge(const Plan& plan) {
    const auto policy = policy::make_tracking(problem_.task, static_cast<Index>(plan.stages.size()));
    StreamKey key = stream_;
    key.stage = Stage::judging;
    const Matrix Theta = policy::to_theta(plan.stages).transpose().replicate(search_.selection, 1);
    rollout::Episodes episodes;
    rollout::simulate_episodes({problem_.model, *policy, problem_.task, key, {}}, Theta, {}, episodes,
                               problem_.evaluator);
    rollouts_ += search_.selection;
    Judged judged{.mean = episodes.returns.mean()};
    Episode episode;
    for (Index row = 0; row < search_.selection; ++row) {
      if (episodes.failed[static_cast<std::size_t>(row)]) {
        ++failed_;
        continue;
      }
      if (!problem_.task.solved) continue;
      episodes.copy(row, episode);
      judged.solving += problem_.task.solved(episode) ? 1.0 / static_cast<double>(search_.selection) : 0;
    }
    return judged;
  }

  const lqr::Problem& problem_;
  const PlanSearch& search_;
  StreamKey stream_;
  PlanProgress progress_;
  Index rollouts_ = 0, failed_ = 0;
};

}  // namespace

std::optional<FoundPlan> search_plan(const lqr::Problem& problem, const PlanSearch& search,
                                     const std::optional<Vector>& last, StreamKey stream,
                                     const ProgressSink& progress) {
  stream.stage = Stage::search;
  return Search(problem, search, stream, progress).run(last);
}

Index steps_to_plan(const Task& task, const PlanSearch& search) {
  if (search.plan_s <= 0) return task.horizon;
  return std::lround(std::clamp(search.plan_s / task.dt_s, 1.0, static_cast<double>(task.horizon)));
}

}  // namespace rehearse::learners::gp_ilqg
