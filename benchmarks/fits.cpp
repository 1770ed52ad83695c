// The gap between fits of kernels and the best of many starts, and the cost of the limit of the signal-to-noise ratio:
// `fits [--quick] [--starts N] [--rows N] [--noisy N] [--exact N]`. Data are seeded: waves, draws from kernels, and the
// steps of a pendubot under random policies. Processor time on one thread.

#include <cmath>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "cpu_time.hpp"
#include "episodes.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/gp/fit.hpp"
#include "rehearse/gp/posterior.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"

namespace {

using namespace rehearse;

/// Rows to learn from, and rows to predict without noise.
struct Data {
  std::string name;
  Matrix X, test_X;
  Vector y, test_y;
  double scale = 1;
};

Matrix normals(Index rows, Index columns, Rng& rng) {
  return Matrix::NullaryExpr(rows, columns, [&] { return rng.normal(); });
}

/// A function with waves of several lengths: of inputs that matter much, little or not at all.
Data smooth_function(Index rows, Index D, double noise, Rng& rng) {
  const Matrix X = normals(2 * rows, D, rng);
  Vector f = Vector::Zero(2 * rows);
  for (int wave = 0; wave < 4; ++wave) {
    Vector slope(D);
    for (Index d = 0; d < D; ++d) slope(d) = rng.normal() * std::pow(0.5, static_cast<double>(d));
    f += rng.normal() *
         (X * slope).array().unaryExpr([phase = rng.uniform(0, 6)](double t) { return std::sin(t + phase); }).matrix();
  }
  const Vector y = f.head(rows) + noise * normals(rows, 1, rng);
  return {"waves", X.topRows(rows), X.bottomRows(rows), y, f.tail(rows), gp::standard_deviation(y)};
}

/// A function drawn from a kernel whose lengths differ by a factor of up to 100.
Data draw(Index rows, Index D, double noise, Rng& rng) {
  const Matrix X = normals(2 * rows, D, rng);
  Vector lengths(D);
  for (double& length : lengths) length = std::exp(rng.uniform(-0.7, 3.9));
  const Matrix Z = X * lengths.cwiseInverse().asDiagonal();
  Matrix K(2 * rows, 2 * rows);
  for (Index i = 0; i < K.rows(); ++i)
    for (Index j = 0; j < K.cols(); ++j) K(i, j) = std::exp(-0.5 * (Z.row(i) - Z.row(j)).squaredNorm());
  K.diagonal().array() += 1e-10;
  const Vector f = K.llt().matrixL() * normals(2 * rows, 1, rng).col(0);
  const Vector y = f.head(rows) + noise * normals(rows, 1, rng);
  return {"draw", X.topRows(rows), X.bottomRows(rows), y, f.tail(rows), gp::standard_deviation(y)};
}

/// A change of a state of the pendubot, measured with noise or without.
Data pendubot_steps(Index rows, Index output, double noise, std::uint64_t seed, Rng& rng) {
  const scenario::Scenario scenario = robots::pendubot::make({});
  const Dataset all = benchmarks::random_episodes(scenario, 2 * rows, seed);
  const FeatureMap features = scenario.task.feature_map();
  Matrix states = all.states.topRows(rows);
  states += noise * normals(rows, states.cols(), rng);
  Vector y = all.changes.col(output).head(rows) + std::sqrt(2.0) * noise * normals(rows, 1, rng);
  return {"pendubot",
          dynamics::gp_inputs(features, states, all.actions.topRows(rows)),
          dynamics::gp_inputs(features, all.states.bottomRows(rows), all.actions.bottomRows(rows)),
          y,
          all.changes.col(output).tail(rows),
          gp::standard_deviation(y)};
}

Data data_set(Index k, Index rows, bool noisy) {
  Rng rng({.seed = 100 + static_cast<std::uint64_t>(k) + (noisy ? 0u : 1000u)});
  const double noise = noisy ? std::pow(10, rng.uniform(-2.5, -0.3)) : 0;
  if (k % 3 == 0) return smooth_function(rows, 2 + k % 5, noise, rng);
  if (k % 3 == 1) return draw(rows, 2 + k % 7, noise, rng);
  return pendubot_steps(rows, k / 3 % 4, noisy ? 0.01 : 0, 1 + static_cast<std::uint64_t>(k), rng);
}

/// The best of many starts, spread over all that the bounds allow near the data, each to the end.
double exhaustive(const gp::Inputs& inputs, const Data& data, Index starts) {
  const gp::Bounds limits;
  const gp::SoftBounds bounds(limits, inputs, data.scale);
  gp::Workspace workspace;
  const optim::Differentiable objective = [&](const Vector& u, Vector& gradient) {
    const double value = gp::evidence(inputs, data.y, bounds.flat(u), workspace, &gradient).value;
    bounds.to_free(u, gradient);
    return value;
  };
  const Vector standard = gp::default_start(inputs, data.y, data.scale).flat();
  const Index D = inputs.dimensions();
  Rng rng({.seed = 7});
  double best = -1e300;
  for (Index k = 0; k < starts; ++k) {
    Vector flat = standard;
    for (Index d = 0; d < D; ++d) flat(d) += rng.uniform(-2.5, 4);
    flat(D) += rng.uniform(-1, 3);
    flat(D + 1) = flat(D) - rng.uniform(0, std::log(limits.max_snr));
    Vector u = bounds.free(bounds.clamped(flat));
    for (int again = 0; again < 3; ++again) {
      const auto found = optim::maximise_bfgs(objective, u, {.max_evaluations = 400, .relative_tolerance = 1e-11});
      best = std::max(best, found.value);
      if (!std::isfinite(found.value)) break;
      u = found.x;
    }
  }
  return best;
}

struct Result {
  gp::Fit fit;
  double ms;
};

Result fit(const gp::Inputs& inputs, const Data& data, const gp::FitOptions& options) {
  const gp::Hyperparameters start = gp::default_start(inputs, data.y, data.scale, options.bounds);
  const double begin = benchmarks::cpu_s();
  gp::Fit fit = gp::fit(inputs, data.y, data.scale, start, options);
  return {std::move(fit), 1e3 * (benchmarks::cpu_s() - begin)};
}

struct Quality {
  double error, log_density;  // root mean square in scales of the targets; nats a row
};

Quality predict(const gp::Inputs& inputs, const Data& data, const gp::Hyperparameters& theta) {
  const gp::Posterior posterior(inputs, data.y, {theta});
  Matrix mean(data.test_X.rows(), 1), variance(data.test_X.rows(), 1);
  posterior.predict(data.test_X, mean, variance);
  const Eigen::ArrayXd error = mean.col(0) - data.test_y, total = variance.col(0).array() + theta.noise_variance();
  return {std::sqrt(error.square().mean()) / data.scale,
          -0.5 * (error.square() / total + total.log() + gp::kLogTwoPi).mean()};
}

double snr(const gp::Fit& fit) { return std::exp(fit.hyperparameters.log_signal - fit.hyperparameters.log_noise); }

constexpr double kMissed = 0.02;  // nats

void study_starts(Index sets, Index rows, Index starts) {
  const Index counts[] = {1, gp::FitOptions().starts, 12, 40};
  Index missed[4] = {};
  double ms[4] = {}, lost[4] = {};
  fmt::print("noisy, {} rows\n| set | inputs | best of {} | 1 start | {} starts (default) | 12 | 40 |\n", rows, starts,
             counts[1]);
  for (Index k = 0; k < sets; ++k) {
    const Data data = data_set(k, rows, true);
    const gp::Inputs inputs(data.X);
    double values[4], best = exhaustive(inputs, data, starts);
    for (int c = 0; c < 4; ++c) {
      gp::FitOptions options;
      options.starts = counts[c];
      const Result result = fit(inputs, data, options);
      values[c] = result.fit.log_evidence, ms[c] += result.ms / static_cast<double>(sets);
      best = std::max(best, values[c]);
    }
    fmt::print("| {} {} | {} | {:.3f} |", data.name, k, inputs.dimensions(), best);
    for (int c = 0; c < 4; ++c) {
      missed[c] += values[c] < best - kMissed, lost[c] += best - values[c];
      fmt::print(" {:.3f} |", values[c] - best);
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
  for (int c = 0; c < 4; ++c)
    fmt::print("{} starts: {} of {} end more than {} nats below, {:.2f} in all; {:.2f} ms a fit\n", counts[c],
               missed[c], sets, kMissed, lost[c], ms[c]);
}

void study_limits(Index sets, Index rows) {
  fmt::print(
      "without noise, {} rows\n| set | inputs | limit | evidence | evaluations | ms | signal-to-noise | jitter | "
      "error | log density |\n",
      rows);
  for (Index k = 0; k < sets; ++k) {
    const Data data = data_set(k, rows, false);
    const gp::Inputs inputs(data.X);
    for (const double limit : {1e4, 1e5, 1e6, 1e7, 1e8}) {
      gp::FitOptions options;
      options.bounds.max_snr = limit;
      options.bounds.noise_floor = std::min(options.bounds.noise_floor, 1 / limit);
      const Result result = fit(inputs, data, options);
      const Quality quality = predict(inputs, data, result.fit.hyperparameters);
      fmt::print("| {} {} | {} | {:.0e} | {:.3f} | {} | {:.1f} | {:.1e} | {:.0e} | {:.2e} | {:.2f} |\n", data.name, k,
                 inputs.dimensions(), limit, result.fit.log_evidence, result.fit.evaluations, result.ms,
                 snr(result.fit), result.fit.jitter, quality.error, quality.log_density);
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Fits of kernels against the best of many starts");
  Index starts = 60, rows = 80, noisy = 60, exact = 9;
  bool quick = false;
  app.add_flag("--quick", quick);
  app.add_option("--starts", starts);
  app.add_option("--rows", rows);
  app.add_option("--noisy", noisy);
  app.add_option("--exact", exact);
  CLI11_PARSE(app, argc, argv);
  if (quick) starts = 3, rows = 30, noisy = exact = 3;
  study_starts(noisy, rows, starts);
  study_limits(exact, rows);
}
