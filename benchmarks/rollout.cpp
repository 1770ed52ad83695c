// The cost of a simulated rollout of the pendubot against its own triangular products, and by parts. Everything is
// measured in turn, in one process, and the least of all repetitions counts: ratios survive a machine that is busy.
// Run with OPENBLAS_CORETYPE unset.

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "cpu_time.hpp"
#include "episodes.hpp"
#include "rehearse/core/processor.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/vector_math.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/gp/prediction_kernel.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"
#include "rehearse/rollout/execute.hpp"
#include "rehearse/rollout/gradient.hpp"
#include "rehearse/rollout/simulate.hpp"

extern "C" {
void openblas_set_num_threads(int threads);
char* openblas_get_corename();
void dtrmm_(const char* side, const char* uplo, const char* transa, const char* diag, const int* m, const int* n,
            const double* alpha, const double* a, const int* lda, double* b, const int* ldb);
}

namespace {

using namespace rehearse;
using benchmarks::cpu_s, benchmarks::random_episodes, benchmarks::random_theta;

constexpr Index kCandidates = 32 * 17;       // descents × population
constexpr Index kStates = kCandidates * 50;  // of all their steps
constexpr Index kRows = 64;                  // of a chunk of rollouts, see rollout/simulate.cpp
constexpr StreamKey kKey{.purpose = Purpose::simulated_noise};

gp::Posterior condition(const Matrix& inputs, const Matrix& targets) {
  std::vector<gp::Hyperparameters> hyperparameters;
  for (const auto& y : targets.colwise()) {
    const double log_deviation = 0.5 * std::log(y.squaredNorm() / static_cast<double>(y.size()));
    hyperparameters.push_back({.log_lengths = Vector::LinSpaced(inputs.cols(), 0.5, 1.5),
                               .log_signal = log_deviation,
                               .log_noise = log_deviation + std::log(0.01)});
  }
  return {gp::Inputs(inputs), targets, hyperparameters};
}

/// A model of the pendubot, and the inputs of its parts: kRows states as rollouts meet them.
struct Setup {
  Setup(Index points, bool with_prior) {
    const Dataset data = random_episodes(pendubot, points);
    Matrix F(points, features.features() + 1), targets = data.changes;
    dynamics::gp_inputs(features, data.states, data.actions, F);
    if (with_prior) {
      Matrix expected(points, 4);
      prior.mean(data.states, data.actions, prior.space.values(), expected);
      targets -= expected;
      mean = dynamics::Mean{prior, prior.space.values()};
    }
    model = std::make_unique<dynamics::GpModel>(features, Kinematics{}, mean, condition(F, targets),
                                                dynamics::PredictedVariance::latent);
    Rng rng({.seed = 2});
    for (auto theta : Theta.colwise()) theta = random_theta(*pendubot.policy, rng);
    for (Index i = 0; i < kRows; ++i) {
      const Index at = rng.below(data.size());
      X.row(i) = data.states.row(at), U.row(i) = data.actions.row(at);
    }
    dynamics::gp_inputs(features, X, U, inputs);
  }

  const scenario::Scenario pendubot = robots::pendubot::make({});
  const FeatureMap features = pendubot.task.feature_map();
  const prior::Prior prior{pendubot.priors[2].name, pendubot.priors[2].simulator, pendubot.priors[2].parameters};
  std::optional<dynamics::Mean> mean;
  std::unique_ptr<dynamics::GpModel> model;
  Matrix Theta{pendubot.policy->parameters(), kCandidates};
  Matrix X{kRows, 4}, U{kRows, 1}, inputs{kRows, 7};
};

void simulate(const Setup& s, const Evaluator& evaluator) {
  benchmark::DoNotOptimize(
      rollout::simulate({*s.model, *s.pendubot.policy, s.pendubot.task, kKey}, s.Theta, {0, 1}, evaluator));
}

/// Gradients from as many particles of one policy.
void differentiate(const Setup& s) {
  benchmark::DoNotOptimize(rollout::return_gradients({*s.model, *s.pendubot.policy, s.pendubot.task, kKey},
                                                     s.Theta.leftCols(1), {0, kCandidates}, serial_evaluator()));
}

/// The triangular products of all outputs by gp's kernel, `rows` ≤ gp::kChunk states at a time.
class Products {
 public:
  Products(const gp::Posterior& gp, Index rows)
      : n_(gp.size()), rows_(rows), columns_(n_, gp::kChunk), packed_(gp::packed_size(n_), gp.outputs()) {
    columns_.setRandom();
    packed_.setRandom();
  }
  void operator()() {
    for (Index done = 0; done < kStates; done += rows_)
      for (Index e = 0; e < packed_.cols(); ++e)
        gp::triangular_norms(packed_.col(e).data(), n_, columns_.data(), std::min(rows_, kStates - done), norms_);
  }

 private:
  Index n_, rows_;
  Matrix columns_, packed_;
  double norms_[gp::kChunk] = {};
};

/// The correlations that these products need, of all outputs.
class Correlations {
 public:
  explicit Correlations(const gp::Posterior& gp)
      : outputs_(gp.outputs()),
        points_(Matrix::Random(gp.dimensions(), gp.size())),
        queries_(Matrix::Random(gp::kChunk, gp.dimensions())),
        weights_(gp.size()),
        columns_(gp.size(), gp::kChunk) {
    weights_.setRandom();
  }
  void operator()() {
    for (Index e = 0; e < outputs_; ++e)
      gp::correlate({points_.data()}, points_.cols(), points_.rows(), weights_.data(), {queries_.data()}, kRows,
                    columns_.data(), means_);
  }

 private:
  Index outputs_;
  Matrix points_, queries_;
  Vector weights_;
  Matrix columns_;
  double means_[gp::kChunk] = {};
};

/// A plain vectorised exp of as many entries.
class Exponentials {
 public:
  explicit Exponentials(const gp::Posterior& gp)
      : outputs_(gp.outputs()), exponents_(-Matrix::Random(kRows, gp.size()).cwiseAbs()), values_(kRows, gp.size()) {}
  void operator()() {
    for (Index e = 0; e < outputs_; ++e) vector_exp(exponents_.data(), values_.data(), values_.size());
  }

 private:
  Index outputs_;
  Matrix exponents_, values_;
};

/// The products by OpenBLAS, 64 columns at a time; each output has its own matrix.
class Dtrmm {
 public:
  explicit Dtrmm(const gp::Posterior& gp) : n_(static_cast<int>(gp.size())), columns_(Matrix::Random(n_, kColumns)) {
    factors_.resize(static_cast<std::size_t>(gp.outputs()), Matrix::Identity(n_, n_));  // neither grows nor vanishes
  }
  void operator()() {
    const double one = 1;
    for (Index done = 0; done < kStates; done += kColumns)
      for (const Matrix& L : factors_)
        dtrmm_("L", "L", "N", "N", &n_, &kColumns, &one, L.data(), &n_, columns_.data(), &n_);
  }

 private:
  static constexpr int kColumns = 64;
  int n_;
  Matrix columns_;
  std::vector<Matrix> factors_;
};

struct Part {
  std::string name;
  std::function<void()> run;  // for kStates states
};

template <class Step>
Part chunked(std::string name, Step step) {
  return {std::move(name), [step]() mutable {
            for (Index done = 0; done < kStates; done += kRows) step();
          }};
}

/// The outputs of the parts.
struct Outputs {
  Matrix mean{kRows, 4}, variance{kRows, 4}, U{kRows, 1}, features{kRows, 6};
  Vector reward{kRows};
  dynamics::Linearised linearised;
};

std::vector<Part> parts_of(const Setup& s, Outputs& out) {
  const gp::Posterior& gp = s.model->posterior();
  const Matrix Theta = s.Theta.leftCols(kRows).transpose();
  const prior::Prior& prior = s.prior;
  const Vector phi = prior.space.values();
  const std::vector<std::uint64_t> names(kRows, 7);
  return {
      {"rollout", [&] { simulate(s, serial_evaluator()); }},
      {"gradient", [&] { differentiate(s); }},
      {"products", Products(gp, kRows)},
      {"wide_products", Products(gp, gp::kChunk)},
      {"dtrmm", Dtrmm(gp)},
      chunked("gp", [&] { gp.predict(s.inputs, out.mean, out.variance); }),
      chunked("linearised", [&] { s.model->linearise(s.X, s.U, out.linearised); }),
      chunked("differences", [&] { s.model->DynamicsModel::linearise(s.X, s.U, out.linearised); }),
      chunked("correlations", Correlations(gp)),
      chunked("exp", Exponentials(gp)),
      chunked("gp_mean", [&] { gp.predict_mean(s.inputs, out.mean); }),
      chunked("features", [&] { s.features.apply(s.X, out.features); }),
      chunked("policy", [&, Theta] { s.pendubot.policy->act(Theta, s.X, 0, out.U); }),
      chunked("prior", [&, phi] { prior.mean(s.X, s.U, phi, out.mean); }),
      chunked("reward", [&] { s.pendubot.task.reward(s.X, s.U, s.X, out.reward); }),
      chunked("normals", [&, names] { fill_normals(kKey, names.data(), names.data(), 3, out.mean); }),
  };
}

/// Arguments: training points; whether there is a prior. Counters: ns of CPU time a state (`gp` is mean and variance,
/// `gradient` a rollout there and back, `linearised` the model with its derivatives, `differences` these as by default,
/// `products` the triangular products of as many rows at a time as a rollout has, `wide_products` of as many as gp
/// takes), and ratios: over the faster products; prior, policy, reward and normals together over the rollout.
void parts(benchmark::State& state) {
  const bool with_prior = state.range(1) != 0;
  const Setup setup(state.range(0), with_prior);
  Outputs outputs;
  const std::vector<Part> all = parts_of(setup, outputs);
  std::vector<double> least(all.size(), std::numeric_limits<double>::infinity());
  for (auto _ : state) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double start = cpu_s();
      all[i].run();
      const double spent = cpu_s() - start;
      if (i == 0) state.SetIterationTime(spent);
      least[i] = std::min(least[i], spent / static_cast<double>(kStates) * 1e9);
    }
  }
  auto& counters = state.counters;
  for (std::size_t i = 0; i < all.size(); ++i) counters[all[i].name] = least[i];
  const auto ns = [&](const char* name) { return counters[name].value; };
  counters["over_products"] = ns("rollout") / std::min(ns("products"), ns("wide_products"));
  counters["correlations_over_exp"] = ns("correlations") / ns("exp");
  counters["over_dtrmm"] = ns("rollout") / ns("dtrmm");
  counters["share_of_small_parts"] =
      ((with_prior ? ns("prior") : 0) + ns("policy") + ns("reward") + ns("normals")) / ns("rollout");
}
BENCHMARK(parts)->ArgsProduct({{50, 200, 500, 1000}, {0, 1}})->UseManualTime()->Unit(benchmark::kMillisecond);

/// All rollouts of a generation, with prior, on one thread and on two: the least wall times, and what two threads take
/// of CPU time, all in all, over what one takes. The machine must have two idle cores for the former.
void threads(benchmark::State& state) {
  const Setup setup(state.range(0), true);
  const std::unique_ptr<Evaluator> evaluators[] = {make_thread_evaluator(1), make_thread_evaluator(2)};
  constexpr double kNever = std::numeric_limits<double>::infinity();
  double wall_s[] = {kNever, kNever}, spent_s[] = {kNever, kNever};
  for (auto _ : state) {
    for (int k = 0; k < 2; ++k) {
      const auto start = std::chrono::steady_clock::now();
      const double cpu_start = cpu_s();
      simulate(setup, *evaluators[k]);
      const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      wall_s[k] = std::min(wall_s[k], wall), spent_s[k] = std::min(spent_s[k], cpu_s() - cpu_start);
      if (k == 1) state.SetIterationTime(wall);
    }
  }
  state.counters["one_ms"] = 1e3 * wall_s[0];
  state.counters["two_ms"] = 1e3 * wall_s[1];
  state.counters["speedup"] = wall_s[0] / wall_s[1];
  state.counters["cpu_ratio"] = spent_s[1] / spent_s[0];
}
BENCHMARK(threads)->Arg(50)->Arg(200)->Arg(500)->Arg(1000)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  openblas_set_num_threads(1);
  benchmark::AddCustomContext("blas_core", openblas_get_corename());
  benchmark::AddCustomContext("vector_target", kernel_target());
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
