// GP-MI in a loop of your own, without the command line and without run folders. It learns the policy of spring.hpp on
// the cart of cart.hpp, and writes the best one as policy.h.

#include <cstdio>
#include <fstream>

#include "cart.hpp"
#include "rehearse/learners/black_drops/black_drops.hpp"
#include "rehearse/policy/exported.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/testing/check_policy.hpp"
#include "spring.hpp"

/// Options have the names that `rehearse list gp-mi` shows. Presets are the command line's: here are defaults alone.
std::unique_ptr<learners::Learner> make_learner(const learners::Setting& setting) {
  for (const auto& builder : learners::black_drops::builders()) {
    if (builder->name() != "gp-mi") continue;
    const auto set = [&](const char* name, const char* value) {
      if (!set_field([&](FieldVisitor& v) { builder->fields(v); }, name, value)) throw InvalidInput(name);
    };
    set("search.race.max_evaluations", "4000");
    set("search.race.descents", "4");
    return builder->build(setting);
  }
  throw InvalidInput("there is no gp-mi");
}

/// Writes a policy as a C header, with its answers in states of an episode for the header's own test.
void write(const char* path, const learners::Setting& setting, const learners::Proposal& tried, const Episode& episode,
           Index trial) {
  const policy::Origin origin{
      .robot = "cart", .learner = "gp-mi", .prior = "light", .trial = trial, .total_reward = episode.total_reward()};
  const Index states = std::min<Index>(16, episode.states.rows());
  const policy::Answers asked{.states = episode.states.topRows(states),
                              .times_s = Vector::LinSpaced(states, 0, (states - 1) * setting.task.dt_s),
                              .actions = {}};
  const policy::Exported exported = policy::make_exported(origin, setting.task, *tried.policy, tried.theta, asked);
  std::ofstream(path) << policy::to_c(exported, "policy");
}

int main() {
  const scenario::Scenario robot = cart()->build();
  const scenario::NamedPrior& guess = robot.priors.front();
  learners::Setting setting;
  setting.task = robot.task;
  setting.policy = std::make_shared<Spring>(robot.task);  // robot.policy is the scenario's
  setting.prior = prior::Prior{guess.name, guess.simulator, guess.parameters};
  setting.evaluator = make_thread_evaluator(0);  // all cores; the results are those of one
  const std::vector<std::string> broken = testing::check_policy(*setting.policy, setting.task);
  for (const std::string& law : broken) std::printf("%s\n", law.c_str());

  const auto plant = robot.make_plant();  // or your own system::Plant
  const auto learner = make_learner(setting);
  double best = -kInf;
  for (Index trial = 1; trial <= 3; ++trial) {
    const learners::Proposal proposal = learner->ask();  // a copy: the reference lives until `tell`
    const Rng rng({.seed = setting.seed, .trial = static_cast<std::uint64_t>(trial), .purpose = Purpose::start_state});
    const Episode episode = rollout::execute(*plant, *proposal.policy, proposal.theta, setting.task, rng);
    learner->tell(episode);
    std::printf("trial %d: return %.2f, mass %.3f%s\n", static_cast<int>(trial), episode.total_reward(),
                (*proposal.phi)(0), setting.task.solved(episode) ? ", solved" : "");
    if (episode.total_reward() <= best) continue;
    best = episode.total_reward();
    write("policy.h", setting, proposal, episode, trial);
  }
  return broken.empty() ? 0 : 1;
}
