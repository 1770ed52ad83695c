#include "rehearse/check/task_answers.hpp"

#include "rehearse/check/differences.hpp"

namespace rehearse::check {

std::vector<std::pair<std::string, Answer>> answers_of(const Task& task) {
  std::vector<std::pair<std::string, Answer>> all;
  all.emplace_back("the reward", [&](const Matrix& X, const Matrix& U, const Matrix& next, VectorView answers) {
    task.reward(X, U, next, answers);
  });
  if (task.ended)
    all.emplace_back("`ended`", [&](const Matrix&, const Matrix&, const Matrix& next, VectorView answers) {
      task.ended(next, answers);
    });
  return all;
}

bool differ(const Vector& one, const Vector& other, double tolerance) {
  const double largest = one.array().isFinite().select(one, 0).cwiseAbs().maxCoeff();
  return (apart(one, other).array() > tolerance * (1 + largest)).any();
}

Episode resting(const Task& task, const Vector& state) {
  const Matrix states = state.transpose().replicate(task.horizon + 1, 1);
  return {.states = states,
          .true_states = states,
          .actions = Matrix::Zero(task.horizon, task.action_size()),
          .rewards = Vector::Zero(task.horizon)};
}

}  // namespace rehearse::check
