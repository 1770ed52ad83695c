#include "rehearse/check/whole_turns.hpp"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "rehearse/check/task_answers.hpp"
#include "rehearse/core/random.hpp"

namespace rehearse::check {
namespace {

constexpr Index kTried = 1000;  // states; fewer where their episodes would have more than so many rows in all
constexpr Index kRows = 100000;
constexpr double kTolerance = 1e-6;

/// The answers on success, too, in states where the robot stays.
std::vector<std::pair<std::string, Answer>> answers_at_rest(const Task& task) {
  std::vector<std::pair<std::string, Answer>> all = answers_of(task);
  if (task.solved)
    all.emplace_back("success", [&](const Matrix& X, const Matrix&, const Matrix&, VectorView solved) {
      for (Index i = 0; i < X.rows(); ++i) solved(i) = task.solved(resting(task, X.row(i))) ? 1 : 0;
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
  const Matrix X = turned_states(task, seed), none = Matrix::Zero(X.rows(), task.action_size());
  for (const auto& [name, answer] : answers_at_rest(task)) {
    const auto of = [&answer = answer, &none](const Matrix& states) {
      Vector answers(states.rows());
      answer(states, none, states, answers);
      return answers;
    };
    const Vector first = of(X);
    for (Index j = 0; j < X.cols(); ++j) {
      const StateVariable& state = task.states[static_cast<std::size_t>(j)];
      if (state.kind != StateKind::angle) continue;
      Matrix turned = X;
      turned.col(j).array() += 2 * std::numbers::pi;
      if (differ(first, of(turned), kTolerance))
        lines.push_back(
            fmt::format("{0} says something else when {1} is a whole turn further: formulas see angles as they are "
                        "counted. If the robot "
                        "may come there either way round, write cos({1}) and sin({1})",
                        name, state.name));
    }
  }
  return lines;
}

}  // namespace rehearse::check
