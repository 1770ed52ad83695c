#include "rehearse/check/try_prior.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include <fmt/format.h>

#include "rehearse/check/differences.hpp"
#include "rehearse/check/row_laws.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/stopwatch.hpp"
#include "rehearse/statistics/columns.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::check {
namespace {

constexpr int kMostTimings = 20;
constexpr double kTimingS = 0.1;

/// A random action, as it may be commanded in state x.
Vector random_action(const Task& task, const Vector& x, Rng& rng) {
  Matrix u(1, task.action_size());
  for (Index i = 0; i < u.cols(); ++i) {
    const Interval bounds = task.actions[static_cast<std::size_t>(i)].bounds;
    u(0, i) = rng.uniform(bounds.low, bounds.high);
  }
  task.actuators().command(x.transpose(), u);
  return u.transpose();
}

/// Values of a tunable parameter that are far from where it starts.
std::vector<double> others(const Parameter& parameter) {
  if (parameter.kind == Parameter::Kind::discrete) return parameter.choices;
  return {parameter.box.low + 0.25 * (parameter.box.high - parameter.box.low),
          parameter.box.low + 0.75 * (parameter.box.high - parameter.box.low)};
}

/// States around those of the steps, ever wider, and random actions: contacts are seldom reached from the start.
Dataset spread(const Task& task, const Dataset& steps, Rng& rng) {
  constexpr std::array kWider = {1, 3, 10};
  Dataset wide = steps;
  const Vector range = (steps.states.colwise().maxCoeff() - steps.states.colwise().minCoeff()).transpose();
  for (Index row = 0; row < wide.size(); ++row) {
    const double wider = kWider[static_cast<std::size_t>(row) % kWider.size()];
    for (Index i = 0; i < task.actuators().own_states(); ++i) {
      const bool angle = task.states[static_cast<std::size_t>(i)].kind == StateKind::angle;
      const double width = angle ? std::numbers::pi : range(i) > 0 ? range(i) : 1;
      wide.states(row, i) += wider * width * rng.uniform(-1, 1);
    }
    wide.actions.row(row) = random_action(task, wide.states.row(row).transpose(), rng).transpose();
  }
  return wide;
}

Matrix predictions(const scenario::NamedPrior& prior, const Dataset& steps, const Vector& phi) {
  Matrix predicted(steps.size(), steps.states.cols());
  system::change_contained(*prior.simulator, steps.states, steps.actions, phi, predicted);
  return predicted;
}

/// True if a parameter changes a prediction. usual: those of its usual value.
bool moves(const scenario::NamedPrior& prior, Index parameter, const Dataset& steps, const Matrix& usual) {
  const Vector tolerated = rounding(steps.states, usual);
  Vector phi = prior.parameters.values();
  for (const double value : others(prior.parameters[parameter])) {
    phi(parameter) = value;
    const Matrix distances = apart(predictions(prior, steps, phi), usual);
    if ((distances.rowwise() - tolerated.transpose()).maxCoeff() > 0) return true;
  }
  return false;
}

/// A line where predictions depend on more than the row. before, predicted: of these steps, one after the other.
std::string broken_law(const Task& task, const scenario::NamedPrior& prior, const Dataset& steps, const Matrix& before,
                       const Matrix& predicted) {
  const std::string again = difference(task, apart(before, predicted), rounding(steps.states, predicted));
  if (!again.empty())
    return fmt::format(
        "predicts something else from the same states and actions a second time ({}), so no run of it "
        "can be repeated",
        again);
  const Dataset few{.states = elsewhere(steps.states), .actions = elsewhere(steps.actions)};
  const Matrix place = apart(predictions(prior, few, prior.parameters.values()), elsewhere(predicted));
  const std::string moved = difference(task, place, rounding(steps.states, predicted));
  return moved.empty() ? moved
                       : fmt::format(
                             "predicts something else of the same rows in another batch ({}): a row's "
                             "prediction must depend on that row alone",
                             moved);
}

/// The tunable parameters that change no prediction, neither of the steps nor further off. predicted: of the steps.
std::vector<std::string> idle_parameters(const scenario::NamedPrior& prior, const Dataset& steps, const Dataset& wide,
                                         const Matrix& predicted) {
  std::vector<Index> unmoved;
  for (Index i = 0; i < prior.parameters.size(); ++i)
    if (prior.parameters[i].tunable() && !moves(prior, i, steps, predicted)) unmoved.push_back(i);
  std::vector<std::string> idle;
  if (unmoved.empty()) return idle;
  const Matrix usual = predictions(prior, wide, prior.parameters.values());
  for (const Index i : unmoved)
    if (!moves(prior, i, wide, usual)) idle.push_back(prior.parameters[i].name);
  return idle;
}

PriorTried try_prior(const Task& task, const scenario::NamedPrior& prior, const Dataset& steps, const Dataset& wide) {
  PriorTried tried{.name = prior.name, .states = steps.size() + wide.size()};
  const Vector phi = prior.parameters.values();
  const Matrix before = predictions(prior, steps, phi);  // it may start
  Matrix predicted(before.rows(), before.cols());
  const Stopwatch in_all;
  for (int i = 0; i < kMostTimings && (i == 0 || in_all.seconds() < kTimingS);
       ++i) {  // the fastest: others use the machine
    const Stopwatch watch;
    tried.failed = system::change_contained(*prior.simulator, steps.states, steps.actions, phi, predicted);
    tried.rows_per_s = std::max(tried.rows_per_s, watch.per_s(steps.size()));
  }
  tried.error = statistics::column_root_mean_squares(predicted - steps.changes);
  tried.broken = broken_law(task, prior, steps, before, predicted);
  if (tried.failed > 0) tried.notes.push_back(without_prediction(task, steps.states, steps.actions, predicted));
  const std::string rounded = difference(task, apart(before, predicted), Vector::Zero(before.cols()));
  if (tried.broken.empty() && !rounded.empty())
    tried.notes.push_back(
        fmt::format("answers differ in their last digits when they are asked for again ({}), so runs "
                    "repeat about as far; NumPy needs contiguous columns, np.asfortranarray(states)",
                    rounded));
  const Matrix as_next = predicted - steps.states - steps.changes;
  const std::string worse = worse_than_nothing(task, tried.error, statistics::column_root_mean_squares(as_next),
                                               statistics::column_root_mean_squares(steps.changes));
  if (!worse.empty()) tried.notes.push_back(worse);
  tried.idle = idle_parameters(prior, steps, wide, predicted);
  return tried;
}

}  // namespace

std::vector<PriorTried> try_priors(const scenario::Scenario& scenario, const Dataset& steps, std::uint64_t seed) {
  Rng rng({.seed = seed, .purpose = Purpose::start_state});
  const Dataset wide = spread(scenario.task, steps, rng);
  std::vector<PriorTried> tried;
  for (const scenario::NamedPrior& prior : scenario.priors)
    tried.push_back(try_prior(scenario.task, prior, steps, wide));
  return tried;
}

}  // namespace rehearse::check
