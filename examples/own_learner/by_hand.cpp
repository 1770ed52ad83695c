// A learner by hand, on a robot that comes with Rehearse: the pendulum. First a checker says whether the learner keeps
// the laws; then it learns in three trials. The loop at the end is all there is to learning: ask for a policy, try it,
// tell what happened. examples/own_robot/gp_mi.cpp is such a loop with GP-MI.

#include <cstdio>

#include "random_search.hpp"
#include "rehearse/robots/pendulum/pendulum.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/testing/check_learner.hpp"

using namespace rehearse;

int main() {
  const scenario::Scenario pendulum = robots::pendulum::builder()->build();
  const scenario::NamedPrior& guess = pendulum.priors.front();
  learners::Setting setting;
  setting.task = pendulum.task;
  setting.policy = pendulum.policy;
  setting.prior = prior::Prior{guess.name, guess.simulator, guess.parameters};

  const auto plant = pendulum.make_plant();
  const auto run_trial = [&](const learners::Proposal& proposal, std::uint64_t trial) {
    Rng rng({.seed = setting.seed, .trial = trial, .purpose = Purpose::start_state});
    return rollout::execute(*plant, *proposal.policy, proposal.theta, setting.task, rng);
  };

  const auto builder = std::move(learners::random_search::builders().front());
  const std::vector<std::string> broken = testing::check_learner(*builder, setting, run_trial);
  for (const std::string& law : broken) std::printf("%s\n", law.c_str());

  const auto learner = builder->build(setting);
  for (std::uint64_t trial = 1; trial <= 3; ++trial) {
    const learners::Proposal proposal = learner->ask();  // a copy: the reference lives until `tell`
    const Episode episode = run_trial(proposal, trial);
    std::printf("trial %d: return %.2f, %.2f were promised\n", static_cast<int>(trial), episode.total_reward(),
                *proposal.predicted_return);
    learner->tell(episode);
  }
  return broken.empty() ? 0 : 1;
}
