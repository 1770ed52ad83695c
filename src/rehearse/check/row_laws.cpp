#include "rehearse/check/row_laws.hpp"

#include <fmt/format.h>

#include "rehearse/check/task_answers.hpp"

namespace rehearse::check {
namespace {

/// The answers on limits, too.
std::vector<std::pair<std::string, Answer>> all_answers_of(const Task& task) {
  std::vector<std::pair<std::string, Answer>> all = answers_of(task);
  for (const Limit& limit : task.limits)
    all.emplace_back("limit " + limit.name,
                     [&](const Matrix& X, const Matrix& U, const Matrix& next, VectorView answers) {
                       limit.holds({X, U, next, Matrix::Zero(U.rows(), U.cols())}, answers);
                     });
  return all;
}

}  // namespace

Matrix elsewhere(const Matrix& rows) { return rows.bottomRows((rows.rows() + 1) / 2).colwise().reverse(); }

std::vector<std::string> broken_row_laws(const Task& task, const Matrix& X, const Matrix& U, const Matrix& dX) {
  std::vector<std::string> lines;
  if (X.rows() == 0) return lines;
  constexpr double kRounding = 1e-10;
  const Matrix next = X + dX;
  for (const auto& [name, answer] : all_answers_of(task)) {
    const auto of = [&answer = answer](const Matrix& states, const Matrix& actions, const Matrix& reached) {
      Vector answers(states.rows());
      answer(states, actions, reached, answers);
      return answers;
    };
    const Vector first = of(X, U, next);
    if (differ(first, of(X, U, next), kRounding))
      lines.push_back(fmt::format(
          "{} answers something else of the same steps a second time, so no run of it can be repeated", name));
    else if (differ(elsewhere(first), of(elsewhere(X), elsewhere(U), elsewhere(next)), kRounding))
      lines.push_back(
          fmt::format("{} answers something else of the same steps in another batch: what it says of a row must depend "
                      "on that row alone",
                      name));
  }
  return lines;
}

}  // namespace rehearse::check
