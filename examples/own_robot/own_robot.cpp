// Your own robot: a cart that is pushed to the origin. Its mass is 1.6 kg, which we do not know: we guess 1 kg, and let
// GP-MI find the mass and a policy in three trials.
//
// Four things are yours: the equation (or any other simulator), the plant, the task, and the policy. The loop at the
// end is all there is to learning: ask for a policy, try it, tell what happened.

#include <cstdio>

#include "rehearse/learners/black_drops/black_drops.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/reward/saturating.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/system/ode.hpp"

using namespace rehearse;

int main() {
  // The equation: state (velocity, position), action force, one parameter.
  const system::Ode cart = [](const Vector& x, const Vector& u, const Vector& phi, Vector& dxdt) {
    dxdt << (u(0) - 0.3 * x(0)) / phi(0), x(0);
  };

  // The guess: the mass may be anything from 0.2 to 5 kg; the search starts at 1 kg.
  const ParameterSpace space({Parameter::continuous("mass", 1, {0.2, 5}, "kg")});
  const prior::Prior guess{"guess", system::make_ode_simulator(cart, space, 0.1, 4), space};

  // The task: from rest at 1 m to the origin within 2 s.
  Task task;
  task.states = {{"velocity", "m/s"}, {.name = "position", .unit = "m", .rate = "velocity"}};
  task.actions = {{"force", "N", {-5, 5}}};
  task.start_mean = Vector{{0, 1}};
  task.start_std = Vector::Zero(2);
  task.dt_s = 0.1;
  task.horizon = 20;
  task.reward = reward::saturating([](const ConstMatrixView& X, VectorView d2) { d2 = X.col(1).cwiseAbs2(); }, 0.2);

  // The robot. Here it is simulated; yours implements system::Plant: reset and step.
  const auto robot = system::make_ode_plant(
      {.ode = cart, .phi = Vector{{1.6}}, .dt_s = task.dt_s, .around = {task.start_mean, task.start_std, {}}});

  learners::Setting setting;
  setting.task = task;
  setting.policy = policy::make_linear({task.feature_map(), Vector{{1, 1}}, {{task.actions[0].bounds}, 1}});
  setting.prior = guess;
  learners::black_drops::Options options;  // GP-MI
  options.search.race.max_evaluations = 4000;
  options.search.race.descents = 4;
  options.search.race.rounds = 2;
  const auto learner = learners::black_drops::make(setting, options);

  for (std::uint64_t trial = 1; trial <= 3; ++trial) {
    const learners::Proposal proposal = learner->ask();
    Rng rng({.seed = setting.seed, .trial = trial, .purpose = Purpose::start_state});
    const Episode episode = rollout::execute(*robot, *proposal.policy, proposal.theta, task, rng);
    std::printf("trial %d: return %.2f, mass %.3f kg\n", static_cast<int>(trial), episode.total_reward(),
                (*proposal.phi)(0));
    learner->tell(episode);
  }
}

// It prints a mass of 1 kg for the first trial and 1.600 kg from the second on.
