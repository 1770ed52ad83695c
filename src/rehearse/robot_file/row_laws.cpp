#include "rehearse/robot_file/row_laws.hpp"

#include <functional>
#include <utility>

#include <fmt/format.h>

#include "rehearse/robot_file/differences.hpp"

namespace rehearse::robot_file {
namespace {

using Answer = std::function<void(const Matrix& X, const Matrix& U, const Matrix& next, VectorView answers)>;

std::vector<std::pair<std::string, Answer>> answers_of(const Task& task) {
  std::vector<std::pair<std::string, Answer>> all;
  all.emplace_back("the reward", [&](const Matrix& X, const Matrix& U, const Matrix& next, VectorView answers) {
    task.reward(X, U, next, answers);
  });
  if (task.ended)
    all.emplace_back("`ended`", [&](const Matrix&, const Matrix&, const Matrix& next, VectorView answers) {
      task.ended(next, answers);
    });
  for (const Limit& limit : task.limits)
    all.emplace_back("limit " + limit.name,
                     [&](const Matrix& X, const Matrix& U, const Matrix& next, VectorView answers) {
                       limit.holds({X, U, next, Matrix::Zero(U.rows(), U.cols())}, answers);
                     });
  return all;
}

/// True if answers are further apart than rounding.
bool differ(const Vector& one, const Vector& other) {
  const double largest = one.array().isFinite().select(one, 0).cwiseAbs().maxCoeff();
  return (apart(one, other).array() > 1e-10 * (1 + largest)).any();
}

}  // namespace

Matrix elsewhere(const Matrix& rows) { return rows.bottomRows((rows.rows() + 1) / 2).colwise().reverse(); }

std::vector<std::string> broken_row_laws(const Task& task, const Matrix& X, const Matrix& U, const Matrix& dX) {
  std::vector<std::string> lines;
  if (X.rows() == 0) return lines;
  const Matrix next = X + dX;
  for (const auto& [name, answer] : answers_of(task)) {
    const auto of = [&answer = answer](const Matrix& states, const Matrix& actions, const Matrix& reached) {
      Vector answers(states.rows());
      answer(states, actions, reached, answers);
      return answers;
    };
    const Vector first = of(X, U, next);
    if (differ(first, of(X, U, next)))
      lines.push_back(fmt::format(
          "{} answers something else of the same steps a second time, so no run of it can be repeated", name));
    else if (differ(elsewhere(first), of(elsewhere(X), elsewhere(U), elsewhere(next))))
      lines.push_back(
          fmt::format("{} answers something else of the same steps in another batch: what it says of a row must depend "
                      "on that row alone",
                      name));
  }
  return lines;
}

}  // namespace rehearse::robot_file
