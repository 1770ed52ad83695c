// The cost of one expected return with its gradient by moment matching: the cases that PILCO's MATLAB code was timed on
// (Octave with OpenBLAS, processor time on one core of a like machine). On one thread; the least of some repetitions.

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>

#include <fmt/core.h>

#include "cpu_time.hpp"
#include "episodes.hpp"
#include "rehearse/core/processor.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/gp/fit.hpp"
#include "rehearse/moments/expected_return.hpp"
#include "rehearse/moments/fitc.hpp"
#include "rehearse/moments/requirements.hpp"
#include "rehearse/policy/rbf.hpp"
#include "rehearse/robots/cartpole/cartpole.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"

namespace {

using namespace rehearse;

struct Case {
  const char* robot;
  Index steps, centres, rows, inducing;  // 0: all rows
  double octave_s;                       // 0: not measured
  Index network = 0;                     // centres of the GPs of a prior that these are around; 0: zero mean
  bool joint_angles = false;  // inputs of the GPs have them too, as learners' do; PILCO's MATLAB code has none
};

constexpr Case kCases[] = {{"cartpole", 40, 10, 40, 0, 0.67},           {"cartpole", 40, 10, 200, 0, 1.1},
                           {"cartpole", 40, 10, 400, 300, 1.9},         {"pendubot", 60, 200, 60, 0, 2.1},
                           {"pendubot", 60, 200, 180, 0, 2.6},          {"pendubot", 60, 200, 300, 0, 3.2},
                           {"pendubot", 60, 200, 400, 300, 3.7},        {"pendubot", 60, 200, 60, 0, 0, 300},
                           {"pendubot", 60, 200, 180, 0, 0, 300},       {"pendubot", 60, 200, 400, 300, 0, 300},
                           {"pendubot", 60, 200, 60, 0, 0, 0, true},    {"pendubot", 60, 200, 180, 0, 0, 0, true},
                           {"pendubot", 60, 200, 400, 300, 0, 0, true}, {"pendubot", 60, 200, 60, 0, 0, 300, true}};

scenario::Scenario make(const Case& c) {
  return std::strcmp(c.robot, "cartpole") == 0 ? robots::cartpole::make({}) : robots::pendubot::make({});
}

Matrix inputs_of(const scenario::Scenario& scenario, const Case& c, const Dataset& data) {
  return dynamics::gp_inputs(moments::model_features(scenario.task, c.joint_angles), data.states, data.actions);
}

/// The time does not depend on its values: what it leaves of the changes is as good as they are.
std::vector<moments::MomentTerm> network(const scenario::Scenario& scenario, const Case& c) {
  const Dataset data = benchmarks::random_episodes(scenario, c.network);
  const gp::Inputs inputs(inputs_of(scenario, c, data));
  std::vector<gp::Hyperparameters> theta;
  for (Index e = 0; e < data.changes.cols(); ++e) theta.push_back(gp::default_start(inputs, data.changes.col(e), 1));
  return moments::mean_terms(moments::exact_terms({inputs, 0.01 * data.changes, theta}));
}

std::shared_ptr<const moments::MomentMatching> learn(const scenario::Scenario& scenario, const Case& c) {
  const Dataset data = benchmarks::random_episodes(scenario, c.rows);
  const Matrix F = inputs_of(scenario, c, data);
  const gp::Inputs inputs(F);
  std::vector<gp::Hyperparameters> theta;
  for (Index e = 0; e < data.changes.cols(); ++e) theta.push_back(gp::default_start(inputs, data.changes.col(e), 1));
  auto terms = c.inducing ? moments::fitc_terms(F, data.changes, F.topRows(c.inducing), theta)
                          : moments::exact_terms({inputs, data.changes, theta});
  if (c.network > 0)
    for (moments::MomentTerm& term : network(scenario, c)) terms.push_back(std::move(term));
  return std::make_shared<moments::MomentMatching>(std::move(terms), data.changes.cols());
}

std::shared_ptr<const policy::Policy> rbf(const Task& task, Index centres) {
  const FeatureMap features = task.feature_map();
  return policy::make_rbf({.features = features,
                           .scale = Vector::Ones(features.features()),
                           .centres = centres,
                           .bounds = {task.actions.front().bounds}});
}

struct Times {
  double value = 1e300, gradient = 1e300;  // s
};

Times time(const Case& c, int repetitions) {
  scenario::Scenario scenario = make(c);
  scenario.task.horizon = c.steps;
  const auto policy = rbf(scenario.task, c.centres);
  const moments::Gaussian start{scenario.task.start_mean, 0.01 * Matrix::Identity(4, 4)};
  const moments::ExpectedReturn expected(scenario.task, *policy, learn(scenario, c), start);
  Rng rng({.seed = 1});
  const Vector theta = Vector::NullaryExpr(policy->parameters(), [&] { return 0.5 * rng.normal(); });
  moments::ReturnWorkspace workspace;
  Vector gradient;
  Times least;
  for (int k = 0; k < repetitions; ++k) {
    for (Vector* wanted : {static_cast<Vector*>(nullptr), &gradient}) {
      const double begin = benchmarks::cpu_s();
      if (!expected(theta, wanted, workspace).ok()) throw std::runtime_error("no return");
      double& best = wanted ? least.gradient : least.value;
      best = std::min(best, benchmarks::cpu_s() - begin);
    }
  }
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
  fmt::print("vector target {}\n\n", kernel_target());
  fmt::print(
      "| robot | joint angles | steps | centres | rows | inducing | prior's | return | with gradient | Octave | ratio "
      "|\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Case& c : kCases) {
    if (quick && c.rows > 60) continue;
    const Times times = time(c, quick ? 1 : 10);
    const auto number = [](Index n) { return n > 0 ? std::to_string(n) : "–"; };
    fmt::print("| {} | {} | {} | {} | {} | {} | {} | {:.2f} ms | {:.2f} ms |", c.robot, c.joint_angles ? "yes" : "–",
               c.steps, c.centres, c.rows, number(c.inducing), number(c.network), 1e3 * times.value,
               1e3 * times.gradient);
    if (c.octave_s > 0)
      fmt::print(" {:.2f} s | {:.0f} |\n", c.octave_s, c.octave_s / times.gradient);
    else
      fmt::print(" – | – |\n");
  }
}
