#pragma once

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/scenario/scenario.hpp"

namespace rehearse::scenario {

/// The last line that is drawn ends where the reward, saturating with this width, sees it: at a state and near it.
inline void expect_drawn_where_rewarded(const Scenario& scenario, const Vector& state, double width) {
  const auto& drawing = std::get<LineDrawing>(*scenario.drawing);
  for (const Vector& x : {state, Vector(state.array() + 0.3)}) {
    const double distance = (drawing.lines(x).back().to - *drawing.goal).norm();
    const Matrix X = x.transpose(), U = Matrix::Zero(1, scenario.task.action_size());
    Vector reward(1);
    scenario.task.reward(X, U, X, reward);
    EXPECT_NEAR(reward(0), std::exp(-distance * distance / (2 * width * width)), 1e-12);
  }
}

}  // namespace rehearse::scenario
