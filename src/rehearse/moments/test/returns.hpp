#pragma once
// A task, a policy and their expected return, whose gradient is compared with differences.

#include <gtest/gtest.h>

#include "fixture.hpp"
#include "rehearse/moments/expected_return.hpp"

namespace rehearse::moments::returns {

struct Problem {
  Problem(const scenario::Scenario& made, Index rows, Index centres, StepDynamics dynamics = {})
      : Problem(made, rows, fixture::rbf(made.task, centres), std::move(dynamics)) {}
  Problem(scenario::Scenario made, Index rows, std::shared_ptr<const policy::Policy> of_policy,
          StepDynamics dynamics = {})
      : scenario(std::move(made)),
        policy(std::move(of_policy)),
        expected(scenario.task, *policy, dynamics ? dynamics : StepDynamics(fixture::random_dynamics(scenario, rows)),
                 Gaussian{scenario.task.start_mean, 0.01 * Matrix::Identity(4, 4)}) {}

  double value(const Vector& theta) {
    const Return result = expected(theta, nullptr, workspace);
    EXPECT_TRUE(result.ok());
    return result.value;
  }

  /// Directions as long as their errors are comparable: single coordinates, or all together.
  void expect_gradient(const Vector& theta, const std::vector<Vector>& directions, double step = 1e-3,
                       double tolerance = 1e-5) {
    Vector gradient;
    ASSERT_TRUE(expected(theta, &gradient, workspace).ok());
    for (const Vector& direction : directions) {
      const double slope = tools::slope([&](double h) { return value(theta + h * direction); }, step);
      EXPECT_NEAR(gradient.dot(direction), slope, tolerance * std::max(std::abs(slope), gradient.norm() * 0.1));
    }
  }

  scenario::Scenario scenario;
  std::shared_ptr<const policy::Policy> policy;
  ExpectedReturn expected;
  ReturnWorkspace workspace;
};

inline std::vector<Vector> coordinates(Index size, Index every = 1) {
  std::vector<Vector> list;
  for (Index k = 0; k < size; k += every) list.push_back(Vector::Unit(size, k));
  return list;
}

inline std::vector<Vector> random_directions(Index size, Index count) {
  std::vector<Vector> list;
  for (Index k = 0; k < count; ++k)
    list.push_back(tools::normals(size, 1, 100 + static_cast<std::uint64_t>(k)).normalized());
  return list;
}

}  // namespace rehearse::moments::returns
