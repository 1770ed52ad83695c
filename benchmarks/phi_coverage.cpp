// The coverage of the true parameters by the 95 % intervals of φ, over random priors: each tunable parameter starts at
// 0.5 to 1.6 times the truth, frictions, which cannot be tuned, are right or anywhere from 0 to twice the truth. Data
// are episodes of random policies: `phi_coverage [--priors N] [--seed S] [--scenario NAME] [--learner NAME] [--noise X]
// [--friction right|wrong] [--out FILE.csv] [--quick]`.

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "episodes.hpp"
#include "rehearse/identification/learn.hpp"
#include "rehearse/robots/cartpole/cartpole.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"
#include "rehearse/statistics/quantiles.hpp"

namespace {

using namespace rehearse;

struct Condition {
  std::string scenario, learner;
  double measurement_noise;
  bool right_friction;
  Index episodes;
};

scenario::Scenario make(const std::string& name, double noise) {
  const auto with_noise = [noise](auto options) {
    options.ode.measurement_noise = noise;
    options.ode.start_noise = noise / 10;
    return options;
  };
  return name == "pendubot" ? robots::pendubot::make(with_noise(robots::pendubot::Options{}))
                            : robots::cartpole::make(with_noise(robots::cartpole::Options{}));
}

/// A prior that nobody tuned for.
prior::Prior random_prior(const scenario::Scenario& scenario, bool right_friction, std::uint64_t seed) {
  Rng rng({.seed = seed});
  const Vector truth = scenario.oracle->parameters().values();
  std::vector<Parameter> parameters = scenario.priors.front().parameters.all();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double tuned = rng.uniform(0.5, 1.6), friction = rng.uniform(0, 2);
    parameters[i].value = truth(static_cast<Index>(i)) * (parameters[i].tunable() ? tuned
                                                          : right_friction        ? 1
                                                                                  : friction);
  }
  return {"random", scenario.priors.front().simulator, ParameterSpace(std::move(parameters))};
}

/// A posterior compared with the truth.
struct Judged {
  std::vector<bool> covered;
  std::vector<double> widths;
  double distance = 0;  // of the truth, squared, in the posterior's own metric: χ² with q degrees of freedom if right
};

Judged judge(const identification::PhiPosterior& posterior, const Vector& truth) {
  const Vector error = truth - posterior.mean;
  const auto intervals = posterior.intervals();
  Judged judged{.distance = error.dot(posterior.covariance.llt().solve(error))};
  for (Index i = 0; i < truth.size(); ++i) {
    const Interval interval = intervals[static_cast<std::size_t>(i)];
    judged.covered.push_back(interval.low <= truth(i) && truth(i) <= interval.high);
    judged.widths.push_back(interval.high - interval.low);
  }
  return judged;
}

/// Posteriors by default, and without the misfit: as if GPs, or white noise, explained all that the prior cannot.
struct Result {
  Judged with_misfit, classical;
};

Result measure(const Condition& condition, std::uint64_t seed) {
  const scenario::Scenario scenario = make(condition.scenario, condition.measurement_noise);
  const prior::Prior prior = random_prior(scenario, condition.right_friction, seed);
  const Dataset data = benchmarks::random_episodes(scenario, condition.episodes * scenario.task.horizon, seed);
  const FeatureMap features = scenario.task.model_features();
  const Vector truth = scenario.oracle->parameters().values()(prior.space.of_kind(Parameter::Kind::continuous));
  const dynamics::Residuals residuals(data, features);
  const identification::PhiPosteriorOptions classical{.misfit_observations = 1e12, .misfit_share = 0};
  const Evaluator& evaluator = serial_evaluator();
  if (condition.learner == "mi") {
    const auto learned = identification::learn({data, features, {}, &prior}, identification::Mi{}, {}, evaluator);
    const auto other =
        identification::phi_posterior(residuals, prior, *learned.state.phi, classical.misfit_observations, evaluator);
    return {judge(learned.posterior.value(), truth), judge(other.value(), truth)};
  }
  const identification::GpMi kind;
  const auto learned = identification::learn({data, features, scenario.task.kinematics(), &prior}, kind, {}, evaluator);
  const identification::FitProblem problem{residuals, &prior, kind.score, kind.gp.fit, evaluator};
  auto fit = identification::unfitted(*learned.state.phi, residuals.scale().size(), learned.state.kernels);
  fit.score = *learned.score;
  const auto other = identification::phi_posterior(problem, fit, classical);
  return {judge(learned.posterior.value(), truth), judge(other.value(), truth)};
}

double chi_squared_95(Index degrees) { return degrees == 3 ? 7.8147 : 9.4877; }

const char* const kHeader =
    "scenario,learner,measurement_noise,friction,episodes,priors,parameter,covered,median_width,covered_classical,"
    "median_width_classical\n";

/// A row a parameter, and one of all together: whether the truth is within the 95 % ellipsoid.
std::string summary(const Condition& condition, const std::vector<Result>& results) {
  const scenario::Scenario scenario = make(condition.scenario, condition.measurement_noise);
  const ParameterSpace& space = scenario.priors.front().parameters;
  const std::vector<Index> tunable = space.of_kind(Parameter::Kind::continuous);
  const std::string start =
      fmt::format("{},{},{},{},{},{}", condition.scenario, condition.learner, condition.measurement_noise,
                  condition.right_friction ? "right" : "wrong", condition.episodes, results.size());
  const auto of_one = [&](std::size_t i, Judged Result::*which) {
    Index covered = 0;
    std::vector<double> widths;
    for (const Result& result : results) {
      covered += (result.*which).covered[i];
      widths.push_back((result.*which).widths[i]);
    }
    return fmt::format("{},{:.3g}", covered, statistics::five_numbers(widths).median);
  };
  const auto of_all = [&](Judged Result::*which) {
    const double radius = chi_squared_95(static_cast<Index>(tunable.size()));
    return std::count_if(results.begin(), results.end(),
                         [&](const Result& result) { return (result.*which).distance <= radius; });
  };
  std::string rows;
  for (std::size_t i = 0; i < tunable.size(); ++i)
    rows += fmt::format("{},{},{},{}\n", start, space[tunable[i]].name, of_one(i, &Result::with_misfit),
                        of_one(i, &Result::classical));
  return rows + fmt::format("{},all,{},,{},\n", start, of_all(&Result::with_misfit), of_all(&Result::classical));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Whether the intervals of phi hold the truth");
  Index priors = 40, threads = 0;
  std::uint64_t seed = 1;
  std::string only, only_learner, only_friction, out;
  double only_noise = -1;
  bool quick = false;
  app.add_option("--priors", priors);
  app.add_option("--seed", seed, "of the first prior");
  app.add_option("--scenario", only);
  app.add_option("--learner", only_learner);
  app.add_option("--noise", only_noise);
  app.add_option("--friction", only_friction, "right or wrong");
  app.add_option("--threads", threads);
  app.add_option("--out", out);
  app.add_flag("--quick", quick);
  CLI11_PARSE(app, argc, argv);
  if (quick) priors = 2;

  const auto evaluator = make_thread_evaluator(static_cast<int>(threads));
  std::string table = kHeader;
  fmt::print("{}", kHeader);
  for (const std::string scenario : {"pendubot", "cartpole"})
    for (const std::string learner : {"gp-mi", "mi"})
      for (const double noise : {0.0, 0.01})
        for (const bool right : {true, false})
          for (const Index episodes : quick ? std::vector<Index>{1} : std::vector<Index>{1, 2, 4}) {
            if (!only.empty() && only != scenario) continue;
            if (!only_learner.empty() && only_learner != learner) continue;
            if (only_noise >= 0 && only_noise != noise) continue;
            if (!only_friction.empty() && only_friction != (right ? "right" : "wrong")) continue;
            const Condition condition{scenario, learner, noise, right, episodes};
            std::vector<Result> results(static_cast<std::size_t>(priors));
            evaluator->for_each(priors, [&](Index i) {
              results[static_cast<std::size_t>(i)] = measure(condition, seed + static_cast<std::uint64_t>(i));
            });
            const std::string rows = summary(condition, results);
            fmt::print("{}", rows);
            std::fflush(stdout);
            table += rows;
          }
  if (!out.empty()) std::ofstream(out) << table;
}
