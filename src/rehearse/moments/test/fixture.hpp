#pragma once
// Tasks, models of their dynamics from random data, and policies.

#include <memory>

#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/gp/fit.hpp"
#include "rehearse/moments/moment_matching.hpp"
#include "rehearse/moments/requirements.hpp"
#include "rehearse/moments/test/gaussian_tools.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/policy/rbf.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::moments::fixture {

/// States about the start, random actions and the changes that follow.
struct Data {
  Matrix inputs, changes;
};
inline Data random_data(const scenario::Scenario& scenario, Index rows, bool joint_angles = false) {
  const Task& task = scenario.task;
  Matrix X = tools::normals(rows, task.state_size(), 1), U(rows, task.action_size());
  X.rowwise() += task.start_mean.transpose();
  Rng rng({.seed = 2});
  for (Index a = 0; a < U.cols(); ++a) {
    const Interval bounds = task.actions[static_cast<std::size_t>(a)].bounds;
    for (double& u : U.col(a)) u = rng.uniform(bounds.low, bounds.high);
  }
  Data data{dynamics::gp_inputs(model_features(task, joint_angles), X, U), Matrix(rows, task.state_size())};
  scenario.oracle->change(X, U, scenario.oracle->parameters().values(), data.changes);
  return data;
}

inline std::vector<gp::Hyperparameters> plain_hyperparameters(const Data& data) {
  std::vector<gp::Hyperparameters> list;
  for (Index e = 0; e < data.changes.cols(); ++e)
    list.push_back(gp::default_start(gp::Inputs(data.inputs), data.changes.col(e), 1));
  return list;
}

inline gp::Posterior random_posterior(const scenario::Scenario& scenario, Index rows, bool joint_angles = false) {
  const Data data = random_data(scenario, rows, joint_angles);
  return {gp::Inputs(data.inputs), data.changes, plain_hyperparameters(data)};
}

inline std::shared_ptr<const MomentMatching> random_dynamics(const scenario::Scenario& scenario, Index rows,
                                                             bool joint_angles = false) {
  return std::make_shared<MomentMatching>(exact_terms(random_posterior(scenario, rows, joint_angles)),
                                          scenario.task.state_size());
}

inline std::shared_ptr<const policy::Policy> rbf(const Task& task, Index centres) {
  const FeatureMap features = task.feature_map();
  return policy::make_rbf({.features = features,
                           .scale = Vector::LinSpaced(features.features(), 1, 2),
                           .centres = centres,
                           .bounds = task.action_bounds()});
}

inline std::shared_ptr<const policy::Policy> linear(const Task& task) {
  const FeatureMap features = task.feature_map();
  return policy::make_linear({.features = features,
                              .scale = Vector::LinSpaced(features.features(), 1, 2),
                              .squash = {task.action_bounds(), 1.5, policy::Squash::Shape::sine}});
}

/// Centres where the features are, targets that use much of the actions.
inline Vector random_theta(const policy::Policy& policy, std::uint64_t seed = 3) {
  return 0.7 * tools::normals(policy.parameters(), 1, seed);
}

}  // namespace rehearse::moments::fixture
