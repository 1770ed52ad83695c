#include "rehearse/robot_file/whole_turns.hpp"

#include <algorithm>
#include <functional>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "rehearse/core/random.hpp"
#include "rehearse/robot_file/differences.hpp"

namespace rehearse::robot_file {
namespace {

constexpr Index kTried = 1000;  // states; fewer where their episodes would have more than so many rows in all
constexpr Index kRows = 100000;
constexpr double kTolerance = 1e-6;

using Answers = std::function<Vector(const Matrix& X)>;

/// An episode that stays in a state.
Episode resting(const Task& task, const Vector& state) {
  const Matrix states = state.transpose().replicate(task.horizon + 1, 1);
  return {.states = states,
          .true_states = states,
          .actions = Matrix::Zero(task.horizon, task.action_size()),
          .rewards = Vector::Zero(task.horizon)};
}

std::vector<std::pair<std::string, Answers>> answers_of(const Task& task) {
  std::vector<std::pair<std::string, Answers>> all;
  all.emplace_back("the reward", [&](const Matrix& X) {
    Vector rewards(X.rows());
    task.reward(X, Matrix::Zero(X.rows(), task.action_size()), X, rewards);
    return rewards;
  });
  if (task.ended)
    all.emplace_back("`ended`", [&](const Matrix& X) {
      Vector ended(X.rows());
      task.ended(X, ended);
      return ended;
    });
  if (task.solved)
    all.emplace_back("success", [&](const Matrix& X) {
      Vector solved(X.rows());
      for (Index i = 0; i < X.rows(); ++i) solved(i) = task.solved(resting(task, X.row(i))) ? 1 : 0;
      return solved;
    });
  return all;
}

/// The start, with the angles anywhere.
Matrix turned_states(const Task& task, std::uint64_t seed) {
  Rng rng({.seed = seed, .trial = 1, .purpose = Purpose::start_state});
  const Index tried = std::clamp<Index>(kRows / (task.horizon + 1), 1, kTried);
  Matrix X = task.start_mean.transpose().replicate(tried, 1);
  for (Index i = 0; i < X.rows(); ++i)
    for (Index j = 0; j < X.cols(); ++j)
      if (task.states[static_cast<std::size_t>(j)].kind == StateKind::angle)
        X(i, j) = rng.uniform(-std::numbers::pi, std::numbers::pi);
  return X;
}

}  // namespace

std::vector<std::string> where_turns_count(const Task& task, std::uint64_t seed) {
  std::vector<std::string> lines;
  const Matrix X = turned_states(task, seed);
  for (const auto& [name, answers] : answers_of(task)) {
    const Vector first = answers(X);
    const double largest = first.array().isFinite().select(first, 0).cwiseAbs().maxCoeff();
    for (Index j = 0; j < X.cols(); ++j) {
      const StateVariable& state = task.states[static_cast<std::size_t>(j)];
      if (state.kind != StateKind::angle) continue;
      Matrix turned = X;
      turned.col(j).array() += 2 * std::numbers::pi;
      if ((apart(first, answers(turned)).array() > kTolerance * (1 + largest)).any())
        lines.push_back(
            fmt::format("{0} says something else when {1} is a whole turn further: formulas see angles as they are "
                        "counted. If the robot "
                        "may come there either way round, write cos({1}) and sin({1})",
                        name, state.name));
    }
  }
  return lines;
}

}  // namespace rehearse::robot_file
