#pragma once
// The slider of all learners with what PILCO needs: a saturating reward and a policy whose moments are known.

#include "rehearse/learners/pilco/pilco.hpp"
#include "rehearse/learners/test/slider.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/policy/rbf.hpp"
#include "rehearse/reward/saturating.hpp"

namespace rehearse::learners::pilco::slider {

using learners::slider::learn, learners::slider::run_trial;

inline Task task() {
  Task task = learners::slider::task();
  const auto squared_distance = [](const ConstMatrixView& X, VectorView d2) { d2 = X.col(0).cwiseAbs2(); };
  task.reward =
      reward::saturating(squared_distance, 0.2, reward::ClosedForm{Vector::Zero(1), Matrix::Constant(1, 1, 1 / 0.2)});
  return task;
}

inline std::shared_ptr<const policy::Policy> rbf() {
  return policy::make_rbf(
      {.features = task().feature_map(), .scale = Vector::Constant(1, 2), .centres = 5, .bounds = {{-1, 1}}});
}

inline std::shared_ptr<const policy::Policy> linear() {
  return policy::make_linear({.features = task().feature_map(),
                              .scale = Vector::Constant(1, 2),
                              .squash = {{{-1, 1}}, 1, policy::Squash::Shape::sine}});
}

inline Setting setting(std::uint64_t seed = 1) {
  Setting setting;
  setting.task = task();
  setting.policy = rbf();
  setting.seed = seed;
  return setting;
}

/// The slider with other φ.
inline prior::Prior prior(double strength, double way_back) {
  const ParameterSpace space({{.name = "strength", .unit = "m/(N s)", .value = strength},
                              {.name = "way_back", .unit = "1/s", .value = way_back}});
  return learners::slider::prior_in(space);
}

}  // namespace rehearse::learners::pilco::slider
