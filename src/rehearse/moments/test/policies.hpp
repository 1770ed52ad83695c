#pragma once
// Policies of three features and two actions, and their moments.

#include <memory>
#include <ostream>
#include <vector>

#include <gtest/gtest.h>

#include "rehearse/moments/analytic_policy.hpp"
#include "rehearse/moments/linear_policy.hpp"
#include "rehearse/moments/test/gaussian_tools.hpp"

namespace rehearse::moments::policies {

inline const FeatureMap kFeatures({StateKind::plain, StateKind::plain, StateKind::plain});
inline const Vector kScale{{1, 2, 0.5}};
inline const std::vector<Interval> kBounds{{-2, 2}, {0, 3}};
inline const policy::RbfOptions kRbf{.features = kFeatures, .scale = kScale, .centres = 8, .bounds = kBounds};
inline const policy::LinearOptions kLinear{
    .features = kFeatures, .scale = kScale, .squash = {kBounds, 1.5, policy::Squash::Shape::sine}};

/// A policy and its moments at a θ.
struct Case {
  std::shared_ptr<const policy::Policy> policy;
  PolicyMomentsAt at;
};
inline void PrintTo(const Case& c, std::ostream* out) { *out << c.policy->name(); }
inline const Case kRbfCase{policy::make_rbf(kRbf), policy_moments(*policy::make_rbf(kRbf))};
inline const Case kLinearCase{policy::make_linear(kLinear), policy_moments(*policy::make_linear(kLinear))};

inline Vector theta(const Case& c) { return tools::normals(c.policy->parameters(), 1, 1); }

inline Transformed action_moments(const Case& c, const Vector& theta, const Gaussian& x) {
  const auto policy = c.at(theta);
  PolicyTape tape;
  Transformed action;
  EXPECT_TRUE(policy->ok() && policy->forward(x, tape, action, serial_evaluator()));
  return action;
}

inline Vector act(const Case& c, const Vector& x) {
  Matrix U(1, 2);
  c.policy->act(theta(c).transpose(), x.transpose(), 0, U);
  return U.row(0).transpose();
}

}  // namespace rehearse::moments::policies
