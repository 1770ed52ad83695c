// A robot with a control loop of its own, which Rehearse does not drive: `ask` and `tell` of docs/real-robot.md as
// functions.
//
//   own_loop FOLDER    the next trials of the run there, which is begun if it is new

#include <cstdio>
#include <fstream>

#include "cart.hpp"
#include "rehearse/experiment/ask_tell.hpp"
#include "rehearse/experiment/run.hpp"
#include "rehearse/learners/black_drops/black_drops.hpp"

/// Your loop. Here an equation plays the robot; yours measures, commands and waits for the next step.
void drive(const policy::Policy& policy, const Vector& theta, const Task& task, const std::string& path) {
  std::ofstream file(path);
  file.precision(17);
  file << "time,velocity,position,force\n";
  Vector x = task.start_mean, dxdt(2);
  Matrix u(1, 1);
  for (Index k = 0; k < task.horizon; ++k) {
    const double time_s = static_cast<double>(k) * task.dt_s;
    policy.act(theta.transpose(), x.transpose(), time_s, u);
    file << time_s << "," << x(0) << "," << x(1) << "," << u(0, 0) << "\n";
    for (int i = 0; i < 100; ++i) {
      equation(x, u.transpose(), Vector{{1.6, 0.3}}, dxdt);
      x += task.dt_s / 100 * dxdt;
    }
  }
  file << task.episode_s() << "," << x(0) << "," << x(1) << ",\n";  // the last row has a state alone
}

void learn(const std::filesystem::path& folder) {
  experiment::Catalogue catalogue;  // what this program knows; a run names its robot and learner
  catalogue.scenarios = {experiment::named(cart)};
  catalogue.learner_families = {learners::black_drops::builders};
  experiment::RunOptions options;
  options.evaluator = make_thread_evaluator(0);
  if (!std::filesystem::exists(folder)) {
    experiment::Spec spec;
    spec.scenario = "cart";
    spec.learner = "gp-mi";
    spec.trials = 0;  // trials come by ask and tell
    spec.options = {{"search.race.max_evaluations", "4000"}, {"search.race.descents", "4"}};
    experiment::start_run(catalogue, spec, folder, options);
  }
  for (int i = 0; i < 2; ++i) {
    const experiment::AskResult asked = experiment::ask_run(catalogue, folder, options);
    const Task& task = asked.resolved.scenario.task;
    const auto policy = experiment::policy_of(asked.trial, asked.resolved.scenario);
    drive(*policy, asked.trial.theta, task, "episode.csv");  // or with asked.folder / "policy.h"
    const auto told = experiment::tell_run(catalogue, folder, {.files = {"episode.csv"}, .stopped = {}}, options);
    std::printf("trial %d: return %.2f, %.2f were predicted%s\n", static_cast<int>(told.trial->trial),
                told.trial->total_reward, *told.trial->predicted_return,
                told.trial->solved.value_or(false) ? ", solved" : "");
    for (const std::string& note : told.trial->notes) std::printf("  %s\n", note.c_str());
  }
}

int main(int argc, char** argv) try {
  learn(argc > 1 ? argv[1] : "run");
} catch (const std::exception& error) {  // InvalidInput: wrong input; RunFailed: what was done before is kept
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
