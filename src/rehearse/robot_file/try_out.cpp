#include "rehearse/robot_file/try_out.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <numbers>

#include <fmt/format.h>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/core/stopwatch.hpp"
#include "rehearse/recording/rates.hpp"
#include "rehearse/robot_file/differences.hpp"
#include "rehearse/robot_file/row_laws.hpp"
#include "rehearse/robot_file/whole_turns.hpp"
#include "rehearse/statistics/root_mean_squares.hpp"
#include "rehearse/system/simulated_plant.hpp"

namespace rehearse::robot_file {
namespace {

struct Steps {
  Matrix X, U, dX;  // measured without noise where the plant knows it
  Vector costs;     // of each step
  std::optional<std::string> end;
  Index ended = 0;
  std::vector<Index> limits, limits_at_once;  // of each limit: episodes that broke it, and in their first step
};

bool keeps(const Limit& limit, const rehearse::Steps& step) {
  Vector kept(1);
  limit.holds(step, kept);
  return is_true(kept(0));
}

/// Computes the cost of the last row's step, step t of its episode, and counts the limits that it breaks. Returns true
/// if there are any.
bool judge(const Task& task, Index row, Index t, Steps& steps) {
  const Matrix x = steps.X.row(row), u = steps.U.row(row), next = x + steps.dX.row(row);
  const Matrix before = t > 0 ? Matrix(steps.U.row(row - 1)) : Matrix::Zero(1, u.cols());
  const rehearse::Steps step{x, u, next, before, static_cast<double>(t) * task.dt_s};
  steps.costs(row) = 0;
  if (task.cost) task.cost(step, steps.costs.segment(row, 1));
  bool any = false;
  for (std::size_t l = 0; l < task.limits.size(); ++l) {
    if (keeps(task.limits[l], step)) continue;
    any = true, ++steps.limits[l], steps.limits_at_once[l] += t == 0;
  }
  return any;
}

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

/// The first prior plays a robot that Rehearse does not drive. Null: there is none either.
std::unique_ptr<system::Plant> plant_or_prior(const scenario::Scenario& scenario) {
  if (scenario.make_plant) return scenario.make_plant();
  if (scenario.priors.empty()) return nullptr;
  const scenario::NamedPrior& prior = scenario.priors.front();
  return system::make_simulated_plant(prior.simulator, prior.parameters.values(),
                                      {scenario.task.start_mean, scenario.task.start_std, {}});
}

Steps drive(const scenario::Scenario& scenario, Index episodes, std::uint64_t seed, const Evaluator& evaluator) {
  const Task& task = scenario.task;
  Steps steps{Matrix(episodes * task.horizon, task.state_size()),
              Matrix(episodes * task.horizon, task.action_size()),
              Matrix(episodes * task.horizon, task.state_size()),
              Vector(episodes * task.horizon),
              {},
              0,
              std::vector<Index>(task.limits.size()),
              std::vector<Index>(task.limits.size())};
  Index row = 0;
  const auto plant = plant_or_prior(scenario);
  const auto state_of = [&](const Vector& measured) {
    const Vector truth = plant->truth();
    Vector state = truth.size() > 0 ? truth : measured;
    if (state.size() != task.state_size())
      throw std::runtime_error(
          fmt::format("the plant's state has {} entries, must have {}", state.size(), task.state_size()));
    return state;
  };
  try {
    for (Index e = 0; plant && e < episodes; ++e) {
      Rng rng({.seed = seed, .trial = static_cast<std::uint64_t>(e) + 1, .purpose = Purpose::start_state});
      const system::EpisodeOn on_plant(*plant);
      Vector x = state_of(plant->reset(rng));
      for (Index t = 0; t < task.horizon; ++t) {
        evaluator.stop_if_asked();
        const Vector u = random_action(task, x, rng), next = state_of(plant->step(u));
        steps.X.row(row) = x, steps.U.row(row) = u, steps.dX.row(row) = next - x;
        x = next, ++row;
        const bool fell = plant->ended() || (task.ended && holds(task.ended, x));
        steps.ended += fell;
        if (judge(task, row - 1, t, steps) || fell) break;
      }
    }
  } catch (const std::exception& error) {
    steps.end = error.what();
  }
  steps.X.conservativeResize(row, Eigen::NoChange);
  steps.U.conservativeResize(row, Eigen::NoChange);
  steps.dX.conservativeResize(row, Eigen::NoChange);
  steps.costs.conservativeResize(row);
  return steps;
}

/// Values of a tunable parameter that are far from where it starts.
std::vector<double> others(const Parameter& parameter) {
  if (parameter.kind == Parameter::Kind::discrete) return parameter.choices;
  return {parameter.box.low + 0.25 * (parameter.box.high - parameter.box.low),
          parameter.box.low + 0.75 * (parameter.box.high - parameter.box.low)};
}

/// A line for a plant that did not repeat itself.
std::string other_things(const Task& task, const Steps& one, const Steps& other) {
  const Index rows = std::min(one.X.rows(), other.X.rows());
  const std::string by =
      difference(task, apart(one.dX.topRows(rows), other.dX.topRows(rows)), Vector::Zero(one.dX.cols()));
  return fmt::format(
      "the plant does other things from the same start and the same random numbers ({}): a simulation must repeat "
      "itself; a real robot is left alone by --no-plant (in Python plant=False)",
      by.empty() ? "episodes end at other steps" : by);
}

/// States around those of the steps, ever wider, and random actions: contacts are seldom reached from the start.
Steps spread(const Task& task, const Steps& steps, Rng& rng) {
  constexpr std::array kWider = {1, 3, 10};
  Steps wide = steps;
  const Vector range = (steps.X.colwise().maxCoeff() - steps.X.colwise().minCoeff()).transpose();
  for (Index row = 0; row < wide.X.rows(); ++row) {
    const double wider = kWider[static_cast<std::size_t>(row) % kWider.size()];
    for (Index i = 0; i < task.actuators().own_states(); ++i) {
      const bool angle = task.states[static_cast<std::size_t>(i)].kind == StateKind::angle;
      const double width = angle ? std::numbers::pi : range(i) > 0 ? range(i) : 1;
      wide.X(row, i) += wider * width * rng.uniform(-1, 1);
    }
    wide.U.row(row) = random_action(task, wide.X.row(row).transpose(), rng).transpose();
  }
  return wide;
}

Matrix predictions(const scenario::NamedPrior& prior, const Steps& steps, const Vector& phi) {
  Matrix predicted(steps.X.rows(), steps.X.cols());
  system::change_contained(*prior.simulator, steps.X, steps.U, phi, predicted);
  return predicted;
}

/// True if a parameter changes a prediction. usual: those of its usual value.
bool moves(const scenario::NamedPrior& prior, Index parameter, const Steps& steps, const Matrix& usual) {
  const Vector tolerated = rounding(steps.X, usual);
  Vector phi = prior.parameters.values();
  for (const double value : others(prior.parameters[parameter])) {
    phi(parameter) = value;
    const Matrix distances = apart(predictions(prior, steps, phi), usual);
    if ((distances.rowwise() - tolerated.transpose()).maxCoeff() > 0) return true;
  }
  return false;
}

/// A line where predictions depend on more than the row. before, predicted: of these steps, one after the other.
std::string broken_law(const Task& task, const scenario::NamedPrior& prior, const Steps& steps, const Matrix& before,
                       const Matrix& predicted) {
  const std::string again = difference(task, apart(before, predicted), rounding(steps.X, predicted));
  if (!again.empty())
    return fmt::format(
        "predicts something else from the same states and actions a second time ({}), so no run of it "
        "can be repeated",
        again);
  const Steps few{.X = elsewhere(steps.X), .U = elsewhere(steps.U)};
  const Matrix place = apart(predictions(prior, few, prior.parameters.values()), elsewhere(predicted));
  const std::string moved = difference(task, place, rounding(steps.X, predicted));
  return moved.empty() ? moved
                       : fmt::format(
                             "predicts something else of the same rows in another batch ({}): a row's "
                             "prediction must depend on that row alone",
                             moved);
}

PriorTried try_prior(const Task& task, const scenario::NamedPrior& prior, const Steps& steps, const Steps& wide) {
  PriorTried tried{.name = prior.name, .states = steps.X.rows() + wide.X.rows()};
  const Matrix before = predictions(prior, steps, prior.parameters.values());  // it may start
  Matrix predicted(steps.X.rows(), steps.X.cols());
  const Stopwatch watch;
  tried.failed = system::change_contained(*prior.simulator, steps.X, steps.U, prior.parameters.values(), predicted);
  tried.rows_per_s = watch.per_s(steps.X.rows());
  tried.error = statistics::root_mean_squares(predicted - steps.dX);
  tried.broken = broken_law(task, prior, steps, before, predicted);
  if (tried.failed > 0) tried.notes.push_back(without_prediction(task, steps.X, steps.U, predicted));
  const std::string rounded = difference(task, apart(before, predicted), Vector::Zero(before.cols()));
  if (tried.broken.empty() && !rounded.empty())
    tried.notes.push_back(
        fmt::format("answers differ in their last digits when they are asked for again ({}), so runs "
                    "repeat about as far; NumPy needs contiguous columns, np.asfortranarray(states)",
                    rounded));
  const std::string worse = worse_than_nothing(task, tried.error, statistics::root_mean_squares(steps.dX));
  if (!worse.empty()) tried.notes.push_back(worse);
  std::vector<Index> unmoved;
  for (Index i = 0; i < prior.parameters.size(); ++i)
    if (prior.parameters[i].tunable() && !moves(prior, i, steps, predicted)) unmoved.push_back(i);
  if (unmoved.empty()) return tried;
  const Matrix usual = predictions(prior, wide, prior.parameters.values());
  for (const Index i : unmoved)
    if (!moves(prior, i, wide, usual)) tried.idle.push_back(prior.parameters[i].name);
  return tried;
}

/// A line for each limit that no policy could keep: the start breaks it, and the first step of every episode.
std::vector<std::string> hopeless_limits(const Task& task, const Steps& steps, Index episodes) {
  std::vector<std::string> lines;
  const Matrix start = task.start_mean.transpose(), none = Matrix::Zero(1, task.action_size());
  for (std::size_t l = 0; l < task.limits.size(); ++l)
    if (steps.limits_at_once[l] == episodes && !keeps(task.limits[l], {start, none, start, none}))
      lines.push_back(
          fmt::format("limit {}: the start breaks it, and the first step of every episode: keep says "
                      "what must hold",
                      task.limits[l].name));
  return lines;
}

/// A line where most steps earn less than those that a fall leaves; empty: they do not.
std::string why_falls_pay(const Task& task, const Steps& steps) {
  if ((!task.ended && task.limits.empty()) || steps.X.rows() == 0) return {};
  Vector rewards(steps.X.rows());
  task.reward(steps.X, steps.U, steps.X + steps.dX, rewards);
  rewards -= steps.costs;
  double sum = 0, least = task.reward_floor;
  Index below = 0;
  for (const double reward : rewards)
    if (reward < task.reward_floor && std::isfinite(reward)) sum += reward, least = std::min(least, reward), ++below;
  if (2 * below <= rewards.size()) return {};
  return fmt::format(
      "steps under random actions earn about {:.3g}, and each step that is left after a fall earns reward.floor = "
      "{:g}: "
      "falling pays, unless the goal earns more; floor = {} would be safe",
      sum / static_cast<double>(below), task.reward_floor, to_text(least));
}

}  // namespace

Tried try_out(const scenario::Scenario& scenario, const Evaluator& evaluator, Index episodes, std::uint64_t seed) try {
  const Steps steps = drive(scenario, episodes, seed, evaluator);
  // A robot that failed, or that somebody stopped, is not to move again.
  const Steps again = steps.end ? steps : drive(scenario, episodes, seed, evaluator);
  const Task& task = scenario.task;
  Tried tried{.steps = steps.X.rows(),
              .episodes = episodes,
              .ended = steps.ended,
              .limits = steps.limits,
              .end = steps.end,
              .change = statistics::root_mean_squares(steps.dX)};
  Vector reward(1);
  const Matrix start = task.start_mean.transpose();
  task.reward(start, Matrix::Zero(1, task.action_size()), start, reward);
  tried.start_reward = reward(0);
  if (!std::isfinite(tried.start_reward))
    tried.broken.push_back(fmt::format("the reward of the start is {}, must be a finite number", tried.start_reward));
  if (task.ended && holds(task.ended, task.start_mean))
    tried.broken.emplace_back("an episode ends where it starts: `ended` holds in the start");
  for (const std::string& line : hopeless_limits(task, steps, episodes)) tried.broken.push_back(line);
  if (const std::string line = why_falls_pay(task, steps); !line.empty()) tried.notes.push_back(line);
  for (const std::string& line : where_turns_count(task, seed)) tried.notes.push_back(line);
  for (const std::string& line : recording::notes_on_rates(task, steps.X, steps.X + steps.dX))
    tried.notes.push_back(line);
  if (!steps.dX.allFinite())
    tried.broken.emplace_back("the plant comes to states that are not finite");
  else if (again.X.rows() != steps.X.rows() || again.dX != steps.dX)
    tried.broken.push_back(other_things(task, steps, again));
  for (const std::string& line : broken_row_laws(task, steps.X, steps.U, steps.dX)) tried.broken.push_back(line);
  if (steps.X.rows() == 0) return tried;
  if (steps.dX.isZero(0))
    tried.broken.emplace_back("no step changes any state: is a formula infinite where it starts?");
  Rng rng({.seed = seed, .trial = static_cast<std::uint64_t>(episodes) + 1, .purpose = Purpose::start_state});
  const Steps wide = spread(task, steps, rng);
  for (const scenario::NamedPrior& prior : scenario.priors) tried.priors.push_back(try_prior(task, prior, steps, wide));
  return tried;
} catch (const system::Unavailable& error) {
  throw InvalidInput(error.what());
}

}  // namespace rehearse::robot_file
