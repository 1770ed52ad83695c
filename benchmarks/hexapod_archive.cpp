// The growth of an archive of the hexapod's gaits with the rollouts spent on it, with the options of the learner ite,
// and the returns of its best gaits on the robot.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/qd/map_elites.hpp"
#include "rehearse/robots/hexapod/hexapod.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/rollout/simulate.hpp"

namespace {

using namespace rehearse;

/// Rollouts in the prior, as the learner makes them.
void evaluate(const scenario::Scenario& robot, const dynamics::DynamicsModel& model, const ConstMatrixView& X,
              VectorView performances, MatrixView descriptors) {
  thread_local rollout::Episodes episodes;
  thread_local Episode episode;
  rollout::simulate_episodes({model, *robot.policy, robot.task, {}, {.sample = false}}, X, {}, episodes);
  for (Index i = 0; i < X.rows(); ++i) {
    performances(i) = std::numeric_limits<double>::quiet_NaN();
    if (episodes.failed[static_cast<std::size_t>(i)]) continue;
    episodes.copy(i, episode);
    performances(i) = episodes.returns(i);
    descriptors.row(i) = robot.task.descriptor(episode).transpose();
  }
}

void print(const scenario::Scenario& robot, const qd::MapElites& search) {
  const qd::Archive& archive = search.archive();
  const auto s = archive.statistics(static_cast<double>(robot.task.horizon) * robot.task.reward_floor);
  const Episode walk = rollout::execute(*robot.make_plant(), *robot.policy, archive.solution(archive.best()),
                                        robot.task, Rng({.purpose = Purpose::test}));
  fmt::print("| {} | {} | {:.0f} | {:.2f} | {:.2f} | {:.2f} |\n", search.evaluations(), s.filled, s.qd_score, s.mean,
             s.best, walk.total_reward());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"How an archive of the hexapod's gaits grows"};
  std::uint64_t evaluations = 200000, seed = 1;
  robots::hexapod::Options options;
  app.add_option("--evaluations", evaluations, "Rollouts in the prior");
  app.add_option("--seed", seed, "Of the search");
  app.add_option("--lag", options.servo_lag_s, "servo_lag_s, s");
  CLI11_PARSE(app, argc, argv);

  scenario::Scenario robot = robots::hexapod::make(options);
  const scenario::NamedPrior& intact = robot.priors[0];
  const dynamics::SimulatorModel model({intact.name, intact.simulator, intact.parameters}, intact.parameters.values());
  const std::vector<Interval> box(static_cast<std::size_t>(robot.policy->parameters()), *robot.policy->box());
  const auto& bounds = robot.task.descriptor_bounds;
  const auto few = static_cast<Index>(evaluations);
  qd::MapElites search({qd::Niches(qd::Grid{bounds, std::vector<Index>(bounds.size(), 5)}), robot.policy->parameters()},
                       {.box = box, .examples = robot.policy->examples()},
                       {.batch = std::min<Index>(512, few), .initial = std::min<Index>(1024, few)}, {.seed = seed});
  const auto rollouts = [&](const ConstMatrixView& X, std::uint64_t, VectorView performances, MatrixView descriptors) {
    evaluate(robot, model, X, performances, descriptors);
  };
  const auto evaluator = make_thread_evaluator(2);
  fmt::print(
      "| rollouts | filled niches of 15 625 | QD score | mean, m | best, m | the best on the robot, m |\n"
      "|---|---|---|---|---|---|\n");
  for (std::uint64_t wanted = 1000; search.evaluations() < evaluations; wanted *= 2) {
    while (search.evaluations() < std::min(wanted, evaluations)) search.step(rollouts, *evaluator);
    print(robot, search);
  }
}
