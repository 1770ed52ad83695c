// Errors of models of the hexapod without its rear left leg for gaits near the tripod that they have not seen: the next
// step, and whole walks. The leg is known to be missing; GPs learn from the first trials. With --damages: the leg that
// GP-MI takes for missing, on robots with any damage.

#include "rehearse/robots/hexapod/hexapod.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "rehearse/dynamics/servos.hpp"
#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/identification/learn.hpp"
#include "rehearse/policy/gait.hpp"
#include "rehearse/robots/hexapod/state.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/rollout/simulate.hpp"

namespace {

using namespace rehearse;
namespace hexapod = robots::hexapod;

constexpr double kSpread = 0.2;  // of the gaits' parameters around the tripod's
constexpr std::uint64_t kToLearnFrom = 1000;

struct Trial {
  Vector theta;
  Episode episode;
};

std::vector<Trial> trials(const scenario::Scenario& robot, Index count, std::uint64_t first) {
  std::vector<Trial> result;
  const auto plant = robot.make_plant();
  for (std::uint64_t i = first; i < first + static_cast<std::uint64_t>(count); ++i) {
    Rng rng({.seed = 1, .trial = i, .purpose = Purpose::random_policy});
    Vector theta = policy::tripod_gait();
    for (double& gene : theta) gene = std::clamp(gene + kSpread * rng.normal(), 0.0, 1.0);
    Episode episode = rollout::execute(*plant, *robot.policy, theta, robot.task, Rng({.seed = 1, .trial = i}));
    result.push_back({std::move(theta), std::move(episode)});
  }
  return result;
}

prior::Prior prior_of(const scenario::Scenario& robot) {
  const scenario::NamedPrior& intact = robot.priors[0];
  prior::Prior prior{"known leg", intact.simulator, intact.parameters, intact.driven};
  prior.space = prior.space.fixed_at(Vector::Zero(1));
  return prior;
}

Dataset data_of(const Trial& trial) {
  Dataset data;
  data.append(trial.episode);
  return data;
}

double rms(double squares, Index count) { return std::sqrt(squares / static_cast<double>(std::max<Index>(count, 1))); }

struct Errors {
  double rotation = 0, position = 0;  // sums of squares, and of how many numbers
  Index rotations = 0, positions = 0;
};

void add_steps(const dynamics::DynamicsModel& model, const Dataset& data, Errors& errors) {
  Matrix change(data.size(), data.states.cols());
  model.predict_mean(data.states, data.actions, change);
  change -= data.changes;
  for (Index i = 0; i < change.rows(); ++i) {
    if (!change.row(i).allFinite()) continue;
    errors.rotation += change.row(i).segment(hexapod::kRotation, 3).squaredNorm();
    errors.position += change.row(i).segment(hexapod::kPosition, 2).squaredNorm();
    errors.rotations += 3;
    errors.positions += 2;
  }
}

struct Walks {
  std::vector<double> real, predicted;  // m, of those that are walked to the end and predicted to be
  int falls = 0, falls_predicted = 0, falls_feared = 0;
};

void add_walk(const dynamics::DynamicsModel& model, const scenario::Scenario& robot, const Trial& trial, Walks& walks) {
  const rollout::Recorded walk = rollout::simulate_recorded(
      {model, *robot.policy, robot.task, {}, {.sample = false, .measurement_noise = 0}}, trial.theta, 1);
  const bool falls =
      !walk.states.back().allFinite() || hexapod::uprightness(walk.states.back().row(0).transpose()) < 0.5;
  const bool fell = trial.episode.ended;
  walks.falls += fell;
  walks.falls_predicted += fell && falls;
  walks.falls_feared += !fell && falls;
  if (fell || falls) return;
  walks.real.push_back(trial.episode.total_reward());
  walks.predicted.push_back(walk.returns(0));
}

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto rank = [](const std::vector<double>& values, std::size_t i) {
    return static_cast<double>(std::ranges::count_if(values, [&](double v) { return v < values[i]; }));
  };
  const auto n = static_cast<double>(a.size());
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += std::pow(rank(a, i) - rank(b, i), 2);
  return 1 - 6 * squares / (n * (n * n - 1));
}

void print(const std::string& name, const Errors& steps, const Walks& walks) {
  double squares = 0;
  for (std::size_t i = 0; i < walks.real.size(); ++i) squares += std::pow(walks.real[i] - walks.predicted[i], 2);
  fmt::print("| {} | {:.3f} | {:.4f} | {:.2f} | {:.2f} | {} of {} | {} |\n", name, rms(steps.rotation, steps.rotations),
             rms(steps.position, steps.positions), rank_correlation(walks.real, walks.predicted),
             rms(squares, static_cast<Index>(walks.real.size())), walks.falls_predicted, walks.falls,
             walks.falls_feared);
}

void evaluate(const std::string& name, const dynamics::DynamicsModel& model, const scenario::Scenario& robot,
              const std::vector<Trial>& unseen) {
  Errors steps;
  Walks walks;
  for (const Trial& trial : unseen) {
    add_steps(model, data_of(trial), steps);
    add_walk(model, robot, trial, walks);
  }
  print(name, steps, walks);
}

using Options = hexapod::Options;

std::vector<std::pair<std::string, Options>> damaged_robots() {
  std::vector<std::pair<std::string, Options>> robots{{"none", {}}};
  using Leg = Options::Leg;
  for (Index leg = 0; leg < hexapod::kLegs; ++leg)
    robots.push_back({fmt::format("without {}", hexapod::kLegNames[static_cast<std::size_t>(leg)]),
                      {.damage = static_cast<Leg>(leg + 1)}});
  for (const auto& [name, kind] : {std::pair("blocked", hexapod::Damage::blocked), {"weak", hexapod::Damage::weak}}) {
    robots.push_back({fmt::format("rear-left {}", name), {.damage = Leg::rear_left, .kind = kind}});
    robots.push_back({fmt::format("rear-left femur {}", name),
                      {.damage = Leg::rear_left, .kind = kind, .joint = Options::Joint::femur}});
  }
  robots.push_back({"without rear-left and mid-left", {.damage = Leg::rear_left, .second_damage = Leg::mid_left}});
  robots.push_back({"without mid-left and mid-right", {.damage = Leg::mid_left, .second_damage = Leg::mid_right}});
  robots.push_back({"without rear-left and rear-right", {.damage = Leg::rear_left, .second_damage = Leg::rear_right}});
  robots.push_back(
      {"without rear-left and front-right", {.damage = Leg::rear_left, .second_damage = Leg::front_right}});
  return robots;
}

/// Prints for each damage the leg that GP-MI takes for missing after so many walks, with the servos learned and
/// without.
void print_identified(const std::vector<Index>& learned_from) {
  const auto evaluator = make_thread_evaluator(2);
  fmt::print("| damage | walks | GP-MI says missing | with servos = false |\n|---|---|---|---|\n");
  for (const auto& [name, options] : damaged_robots()) {
    const scenario::Scenario robot = hexapod::make(options);
    const scenario::NamedPrior& intact = robot.priors[0];
    const prior::Prior prior{intact.name, intact.simulator, intact.parameters, intact.driven};
    for (const Index n : learned_from) {
      Dataset data;
      for (const Trial& trial : trials(robot, n, kToLearnFrom)) data.append(trial.episode);
      fmt::print("| {} | {} |", name, n);
      for (const bool servos : {true, false}) {
        identification::GpMi kind;
        kind.gp.servos = servos;
        const auto learned = identification::learn({data, robot.task.model_features(), robot.task.kinematics(), &prior},
                                                   kind, {}, *evaluator);
        const auto leg = static_cast<Index>((*learned.state.phi)(0));
        fmt::print(" {} |", leg < 0 ? "none" : hexapod::kLegNames[static_cast<std::size_t>(leg)]);
      }
      fmt::print("\n");
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Models of the hexapod without a leg, on gaits they have not seen"};
  Index count = 40;
  std::vector<Index> learned_from{2, 4, 8};
  app.add_option("--trials", count, "To predict");
  app.add_option("--learn", learned_from, "Trials to learn from");
  bool quick = false;
  app.add_flag("--quick", quick, "Only see that it runs");
  bool damages = false;
  app.add_flag("--damages", damages, "Only which leg GP-MI says is missing");
  CLI11_PARSE(app, argc, argv);
  if (quick) count = 3, learned_from = {1};
  if (damages) return print_identified(learned_from), 0;

  hexapod::Options options;
  options.damage = hexapod::Options::Leg::rear_left;
  const scenario::Scenario robot = hexapod::make(options);
  const prior::Prior prior = prior_of(robot);
  const dynamics::SimulatorModel as_given(prior, Vector::Zero(1)), driven(prior.behind_servos(), Vector::Zero(1));
  const std::vector<Trial> unseen = trials(robot, count, 1);

  fmt::print(
      "| model | rotation, rad a step | position, m a step | walks: rank correlation | error, m | falls predicted "
      "| feared in vain |\n|---|---|---|---|---|---|---|\n");
  evaluate("the prior", as_given, robot, unseen);
  Errors told;
  for (const Trial& trial : unseen)
    add_steps(driven, dynamics::reached(data_of(trial), robot.task.kinematics().servos), told);
  fmt::print("| the prior, told where the joints got to | {:.3f} | {:.4f} | | | | |\n",
             rms(told.rotation, told.rotations), rms(told.position, told.positions));
  for (const Index n : learned_from) {
    Dataset data;
    for (const Trial& trial : trials(robot, n, kToLearnFrom)) data.append(trial.episode);
    const auto evaluator = make_thread_evaluator(2);
    identification::FixedPrior kind;
    const auto servos = std::make_shared<dynamics::Servos>(data, robot.task.model_features(),
                                                           robot.task.kinematics().servos, kind.gp, *evaluator);
    evaluate(fmt::format("behind servos of {} trials", n),
             dynamics::ServoModel(servos, std::make_shared<dynamics::SimulatorModel>(driven)), robot, unseen);
    for (const bool behind_servos : {true, false}) {
      kind.gp.servos = behind_servos;
      const auto learned = identification::learn({data, robot.task.model_features(), robot.task.kinematics(), &prior},
                                                 kind, {}, *evaluator);
      evaluate(behind_servos ? "and with GPs" : "GPs alone", *learned.model, robot, unseen);
    }
  }
}
