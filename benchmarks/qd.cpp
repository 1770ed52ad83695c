// MAP-Elites on known ground: `qd_benchmark [--quick] [--out FILE.json] [--commit HASH] [--threads N] [--seed S]`.
//
// arm: a planar arm of 12 links of length 1, each angle in [−π, π]; performance −variance of the angles, descriptor the
// end effector's position in [−12, 12]², 10 000 niches of a Voronoi tessellation (the setting of pyribs's tutorial on
// the arm, after Vassiliades 2018; iso + line with the paper's σ).
// sphere, rastrigin: 20-D linear projection in the setting of pyribs's example sphere.py, algorithm line_map_elites
// (Fontaine 2020, section 4): optimum at 0.4 · 5.12, performance from 100 to 0 at the corner −5.12, 100 × 100 grid, 540
// solutions a generation, σ_iso 0.5 and σ_line 0.2 in the units of the parameters, started at 0, no box.

#include <chrono>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cpu_time.hpp"
#include "rehearse/core/processor.hpp"
#include "rehearse/core/vector_math.hpp"
#include "rehearse/qd/map_elites.hpp"

namespace {

using namespace rehearse;
using std::numbers::pi;

constexpr Index kJoints = 12, kDimension = 20;
constexpr double kEdge = 5.12, kOptimum = 0.4 * kEdge;

void arm(const ConstMatrixView& X, std::uint64_t, VectorView performances, MatrixView descriptors) {
  thread_local Matrix angles, sines, cosines;
  const Index n = X.rows();
  for (Matrix* m : {&angles, &sines, &cosines}) m->resize(n, kJoints);
  angles.col(0) = X.col(0);
  for (Index j = 1; j < kJoints; ++j) angles.col(j) = angles.col(j - 1) + X.col(j);
  vector_sin_cos(angles.data(), sines.data(), cosines.data(), angles.size());
  descriptors.col(0) = cosines.rowwise().sum();
  descriptors.col(1) = sines.rowwise().sum();
  performances = X.rowwise().squaredNorm() / kJoints;
  performances -= (X.rowwise().sum() / kJoints).cwiseAbs2();
  performances = -performances;
}

/// Sums of the first and of the second half of the parameters, those beyond the edge replaced by 5.12 / x.
void project(const ConstMatrixView& X, MatrixView descriptors) {
  descriptors.setZero();
  for (Index p = 0; p < X.cols(); ++p)
    for (Index i = 0; i < X.rows(); ++i) {
      const double x = X(i, p);
      descriptors(i, 2 * p / X.cols()) += std::abs(x) > kEdge ? kEdge / x : x;
    }
}

double squared(double x) { return x * x; }

void sphere(const ConstMatrixView& X, std::uint64_t, VectorView performances, MatrixView descriptors) {
  project(X, descriptors);
  const double worst = squared(kEdge + kOptimum) * static_cast<double>(X.cols());
  performances.setZero();
  for (Index p = 0; p < X.cols(); ++p) performances.array() += (X.col(p).array() - kOptimum).square();
  performances = 100 * (1 - performances.array() / worst);
}

void rastrigin(const ConstMatrixView& X, std::uint64_t, VectorView performances, MatrixView descriptors) {
  thread_local Matrix turns, sines, cosines;
  for (Matrix* m : {&turns, &sines, &cosines}) m->resize(X.rows(), X.cols());
  project(X, descriptors);
  turns = 2 * pi * (X.array() - kOptimum);
  vector_sin_cos(turns.data(), sines.data(), cosines.data(), turns.size());
  const double corner = -kEdge - kOptimum;
  const double worst = static_cast<double>(X.cols()) * (10 + squared(corner) - 10 * std::cos(2 * pi * corner));
  performances.setConstant(10.0 * static_cast<double>(X.cols()));
  for (Index p = 0; p < X.cols(); ++p)
    performances.array() += (X.col(p).array() - kOptimum).square() - 10 * cosines.col(p).array();
  performances = 100 * (1 - performances.array() / worst);
}

struct Problem {
  const char* name;
  qd::Evaluate evaluate;
  double floor;  // of the QD score
  std::function<qd::MapElites(const Evaluator&, std::uint64_t seed)> search;
};

qd::MapElites search_arm(const Evaluator& evaluator, std::uint64_t seed) {
  const qd::Cvt cvt{.bounds = std::vector<Interval>(2, {-1.0 * kJoints, 1.0 * kJoints}), .seed = seed};
  return {qd::Archive(qd::Niches(cvt, evaluator), kJoints),
          {.box = std::vector<Interval>(kJoints, {-pi, pi})},
          {.batch = 1024, .initial = 1024},
          {.seed = seed}};
}

qd::MapElites search_projection(const Evaluator&, std::uint64_t seed) {
  const double side = kEdge * kDimension / 2;
  return {qd::Archive(qd::Niches(qd::Grid{std::vector<Interval>(2, {-side, side}), {100, 100}}), kDimension),
          {.start = Vector::Zero(kDimension)},
          {.batch = 540, .initial = 540, .variation = {.iso_sigma = 0.5, .line_sigma = 0.2}},
          {.seed = seed}};
}

const std::vector<Problem> kProblems{{"arm", arm, -pi* pi, search_arm},
                                     {"sphere", sphere, 0, search_projection},
                                     {"rastrigin", rastrigin, 0, search_projection}};

double wall_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Runs up to each of the milestones (evaluations, rounded up to a generation).
nlohmann::json run(const Problem& problem, const std::vector<double>& milestones, int threads, std::uint64_t seed) {
  const auto evaluator = make_thread_evaluator(threads);
  const double begin = wall_s();
  qd::MapElites search = problem.search(*evaluator, seed);
  nlohmann::json row{{"problem", problem.name}, {"seed", seed}, {"threads", threads}, {"setup_s", wall_s() - begin}};
  double wall = 0, cpu = 0;
  for (const double milestone : milestones) {
    const double wall_before = wall_s(), cpu_before = benchmarks::cpu_s();
    while (static_cast<double>(search.evaluations()) < milestone) search.step(problem.evaluate, *evaluator);
    wall += wall_s() - wall_before;
    cpu += benchmarks::cpu_s() - cpu_before;
    const auto n = static_cast<double>(search.evaluations());
    const qd::Statistics s = search.archive().statistics(problem.floor);
    row["at"].push_back({{"evaluations", n},
                         {"coverage", s.coverage},
                         {"qd_score", s.qd_score},
                         {"best", s.best},
                         {"mean", s.mean},
                         {"evaluations_per_s", n / wall},
                         {"evaluations_per_cpu_s", n / cpu}});
    fmt::print("| {} | {:.0e} | {:.2f} % | {:.0f} | {:.4g} | {:.2f} | {:.2f} |\n", problem.name, milestone,
               100 * s.coverage, s.qd_score, s.best, 1e-6 * n / wall, 1e-6 * n / cpu);
  }
  return row;
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

double load() {
  double minute = 0;
  std::ifstream("/proc/loadavg") >> minute;
  return minute;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("MAP-Elites on a planar arm and on linear projections");
  bool quick = false;
  int threads = 2;
  std::uint64_t seed = 1;
  std::string out, only, commit = "unknown";
  app.add_flag("--quick", quick);
  app.add_option("--threads", threads);
  app.add_option("--seed", seed);
  app.add_option("--problem", only);
  app.add_option("--out", out);
  app.add_option("--commit", commit);
  CLI11_PARSE(app, argc, argv);

  const std::vector<double> milestones = quick ? std::vector{2e4} : std::vector{1e5, 1e6, 1e7};
  nlohmann::json report{{"processor", processor()},
                        {"load", load()},
                        {"vector_target", kernel_target()},
                        {"commit", commit},
                        {"threads", threads}};
  fmt::print("| problem | evaluations | coverage | QD score | best | million/s | million/s of processor time |\n");
  fmt::print("|---|---|---|---|---|---|---|\n");
  for (const Problem& problem : kProblems)
    if (only.empty() || only == problem.name) report["rows"].push_back(run(problem, milestones, threads, seed));
  if (!out.empty()) std::ofstream(out) << report.dump(1) << '\n';
}
