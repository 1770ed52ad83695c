// The errors and the speed of predictions within a tolerance (gp::Posterior) against exact ones, on models that the
// learners of every built-in scenario made of real episodes: `tolerance [--quick] [--out FILE.json] [--commit HASH]`.
// The states compared are those of simulated rollouts of the policies that were tried, of perturbed ones and of random
// ones.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/catalogue.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/identification/learn.hpp"
#include "rehearse/learners/black_drops/black_drops.hpp"
#include "rehearse/rollout/execute.hpp"

namespace {

using namespace rehearse;
namespace bd = learners::black_drops;

struct Size {
  Index trials = 5, states = 40000, evaluations = 5000;  // states of each model: 10⁶ of all
};

/// A learning run: what it saw, what it tried.
struct Experience {
  Dataset data;
  std::vector<Vector> policies;
};

bd::Options options_of(identification::Kind kind, Index evaluations) {
  bd::Options options{.model = std::move(kind)};
  options.search.race.max_evaluations = evaluations;
  options.search.race.descents = 4;
  return options;
}

Experience learn_and_try(const scenario::Scenario& scenario, const std::optional<prior::Prior>& prior,
                         const identification::Kind& kind, const Size& size,
                         std::shared_ptr<const Evaluator> evaluator) {
  const auto learner =
      bd::make({.task = scenario.task, .policy = scenario.policy, .prior = prior, .evaluator = std::move(evaluator)},
               options_of(kind, size.evaluations));
  const auto plant = scenario.make_plant();
  Experience experience;
  for (Index trial = 1; trial <= size.trials; ++trial) {
    const learners::Proposal& proposal = learner->ask();
    if (proposal.policy == scenario.policy) experience.policies.push_back(proposal.theta);  // not a random schedule
    const Rng rng({.seed = 1, .trial = static_cast<std::uint64_t>(trial), .purpose = Purpose::start_state});
    const Episode episode = rollout::execute(*plant, *proposal.policy, proposal.theta, scenario.task, rng);
    learner->tell(episode);
    experience.data.append(episode);
  }
  return experience;
}

/// A policy tried, perturbed or not, or a random one.
Vector some_policy(const std::vector<Vector>& tried, Index which, Rng& rng) {
  Vector theta = tried[static_cast<std::size_t>(rng.below(static_cast<Index>(tried.size())))];
  const double deviations[] = {0, 0.1, 1, 0};
  for (double& value : theta) value += deviations[which % 4] * rng.normal();
  if (which % 4 == 3)
    for (double& value : theta) value = rng.uniform(-5, 5);
  return theta;
}

/// GP inputs of simulated rollouts.
Matrix inputs_of_rollouts(const dynamics::GpModel& model, const scenario::Scenario& scenario,
                          const std::vector<Vector>& tried, Index count) {
  const FeatureMap features = scenario.task.model_features();
  const Index particles = 8;
  Matrix F(count, features.features() + scenario.task.action_size());
  Rng rng({.seed = 2});
  Index filled = 0;
  for (Index which = 0; filled < count; ++which) {
    const Vector theta = some_policy(tried, which, rng);
    const StreamKey key{.seed = 2, .trial = static_cast<std::uint64_t>(which), .stage = Stage::prediction};
    const auto recorded = rollout::simulate_recorded({model, *scenario.policy, scenario.task, key}, theta, particles);
    const Matrix Theta = theta.transpose().replicate(particles, 1);
    Matrix U(particles, scenario.task.action_size()), inputs(particles, F.cols());
    for (std::size_t t = 0; t + 1 < recorded.states.size() && filled < count; ++t) {
      const Matrix& X = recorded.states[t];
      scenario.policy->act(Theta, X, static_cast<double>(t) * scenario.task.dt_s, U);
      dynamics::gp_inputs(features, X, U, inputs);
      for (Index p = 0; p < particles && filled < count; ++p)
        if (X.row(p).allFinite()) F.row(filled++) = inputs.row(p);
    }
  }
  return F;
}

struct Timed {
  Matrix mean, deviation;
  double us_per_state = 0;
};

Timed predict(const gp::Posterior& posterior, const Matrix& F) {
  Timed timed{Matrix(F.rows(), posterior.outputs()), Matrix(F.rows(), posterior.outputs())};
  const std::clock_t start = std::clock();  // of the processor: other work on the machine does not count
  posterior.predict(F, timed.mean, timed.deviation);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  timed.us_per_state = 1e6 * seconds / static_cast<double>(F.rows());
  timed.deviation = timed.deviation.cwiseSqrt();
  return timed;
}

std::shared_ptr<const dynamics::GpModel> model_of(const Experience& experience, const scenario::Scenario& scenario,
                                                  const std::optional<prior::Prior>& prior, identification::Kind kind,
                                                  double tolerance, const Evaluator& evaluator) {
  const auto set = [&](auto& k) {
    if constexpr (requires { k.gp; }) k.gp.tolerance = tolerance;
  };
  std::visit(set, kind);
  auto learned = identification::learn(
      {experience.data, scenario.task.model_features(), scenario.task.kinematics(), prior ? &*prior : nullptr}, kind,
      {}, evaluator);
  return std::dynamic_pointer_cast<const dynamics::GpModel>(learned.model);
}

nlohmann::json compare(const gp::Posterior& exact, const gp::Posterior& few, const Matrix& F) {
  const Timed a = predict(exact, F), b = predict(few, F);
  nlohmann::json row{{"points", exact.size()},
                     {"states", F.rows()},
                     {"exact_us", a.us_per_state},
                     {"tolerance_us", b.us_per_state},
                     {"faster", a.us_per_state / b.us_per_state}};
  for (Index e = 0; e < exact.outputs(); ++e) {
    const double noise = std::sqrt(exact.noise_variances()(e));
    row["outputs"].push_back(
        {{"signal_to_noise", std::exp(exact.hyperparameters()[static_cast<std::size_t>(e)].log_signal) / noise},
         {"mean_points", few.mean_points(e)},
         {"variance_points", few.variance_points(e)},
         {"deviation_error", (a.deviation - b.deviation).col(e).cwiseAbs().maxCoeff() / noise},
         {"mean_error", (a.mean - b.mean).col(e).cwiseAbs().maxCoeff() / noise}});
  }
  return row;
}

double worst(const nlohmann::json& row, const char* key) {
  double value = 0;
  for (const auto& output : row["outputs"]) value = std::max(value, output[key].get<double>());
  return value;
}

void print(const nlohmann::json& row) {
  std::string points;
  for (const auto& output : row["outputs"])
    points += fmt::format(" {}/{}", output["mean_points"].get<Index>(), output["variance_points"].get<Index>());
  fmt::print(
      "{:<10} {:<17} {:<11} n {:>4}, mean/variance points{}: {:.2f} -> {:.2f} us a state, {:.1f} times; errors in "
      "σ_n: std {:.2g}, mean {:.2g}\n",
      row["scenario"].get<std::string>(), row["learner"].get<std::string>(), row["prior"].get<std::string>(),
      row["points"].get<Index>(), points, row["exact_us"].get<double>(), row["tolerance_us"].get<double>(),
      row["faster"].get<double>(), worst(row, "deviation_error"), worst(row, "mean_error"));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Predictions within a tolerance against exact ones");
  Size size;
  bool quick = false;
  std::string out, only, commit;
  app.add_flag("--quick", quick);
  app.add_option("--states", size.states);
  app.add_option("--trials", size.trials);
  app.add_option("--scenario", only);
  app.add_option("--out", out);
  app.add_option("--commit", commit);
  CLI11_PARSE(app, argc, argv);
  if (quick) size = {.trials = 2, .states = 2000, .evaluations = 500};

  const std::shared_ptr<const Evaluator> evaluator = make_thread_evaluator(0);
  nlohmann::json rows = nlohmann::json::array();
  double error = 0;
  const auto examine = [&](const scenario::Scenario& scenario, const std::string& learner,
                           const std::optional<prior::Prior>& prior, const identification::Kind& kind) {
    const Experience experience = learn_and_try(scenario, prior, kind, size, evaluator);
    const auto exact = model_of(experience, scenario, prior, kind, 0, *evaluator);
    const auto few = model_of(experience, scenario, prior, kind, 0.01, *evaluator);
    const Matrix F = inputs_of_rollouts(*few, scenario, experience.policies, size.states);
    nlohmann::json row = compare(exact->posterior(), few->posterior(), F);
    row["scenario"] = scenario.name, row["learner"] = learner, row["prior"] = prior ? prior->name : "none";
    error = std::max(error, worst(row, "deviation_error"));
    print(row);
    rows.push_back(std::move(row));
  };
  for (const auto& builder : apps::catalogue().scenario_builders()) {
    const scenario::Scenario scenario = builder->build();
    if (!only.empty() && scenario.name != only) continue;
    examine(scenario, "black-drops", {}, identification::ZeroMean());
    for (const scenario::NamedPrior& named : scenario.priors) {
      const prior::Prior prior{named.name, named.simulator, named.parameters};
      examine(scenario, "black-drops-prior", prior, identification::FixedPrior());
      examine(scenario, "gp-mi", prior, identification::GpMi());
      if (quick) break;
    }
    if (quick) break;
  }
  if (!out.empty()) std::ofstream(out) << nlohmann::json{{"commit", commit}, {"rows", rows}}.dump(1) << '\n';
  fmt::print("largest error of a standard deviation: {:.2g} σ_n\n", error);
  return error <= 0.01 ? 0 : 1;
}
