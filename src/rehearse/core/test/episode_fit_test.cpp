#include "rehearse/core/episode_fit.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse {
namespace {

using Lines = std::vector<std::string>;

Task two_states() {
  Task task;
  task.states = {{"v", "m/s"}, {"x", "m"}};
  task.actions = {{"u", "N", {-1, 1}}};
  return task;
}

Episode three_steps() {
  return {.states = Matrix::Ones(4, 2),
          .true_states = Matrix::Ones(4, 2),
          .actions = Matrix::Ones(3, 1),
          .rewards = Vector::Ones(3)};
}

TEST(EpisodeFit, NamesEachPartThatDoesNot) {
  const Task task = two_states();
  EXPECT_EQ(misfits(three_steps(), task), Lines{});
  EXPECT_EQ(misfits({.states = Matrix::Ones(1, 2),
                     .true_states = Matrix::Ones(1, 2),
                     .actions = Matrix(0, 1),
                     .rewards = Vector()},
                    task),
            Lines{})
      << "of no step";
  Episode wrong = three_steps();
  wrong.states = Matrix::Ones(3, 2);
  wrong.true_states = Matrix();
  wrong.rewards(1) = std::nan("");
  EXPECT_EQ(misfits(wrong, task), (Lines{"the episode's states are 3 × 2, must be 4 × 2",
                                         "the episode's true_states are 0 × 0, must be 4 × 2",
                                         "the episode's rewards(1, 0) = nan, must be finite"}));
  wrong = three_steps();
  wrong.actions = Matrix::Ones(3, 2);
  EXPECT_THROW(require_fit(wrong, task), InvalidInput);
}

}  // namespace
}  // namespace rehearse
