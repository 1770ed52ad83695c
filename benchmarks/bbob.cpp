// The evaluations that BIPOP-CMA-ES needs on functions of the BBOB testbeds, beside the published numbers, and the cost
// of a generation. `bbob [--quick] [--out FOLDER] [--commit HASH]` writes bbob.md and bbob.json.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bbob_functions.hpp"
#include "rehearse/core/processor.hpp"
#include "rehearse/optim/restarts.hpp"

namespace {

using namespace rehearse;
using Clock = std::chrono::steady_clock;

constexpr double kTargets[] = {1e-7, 1e-8};  // 1e-7 is the last that the published tables give

struct Case {
  int function;
  Index dimension;
  Index max_evaluations;
  bool uncertainty;
  double published;  // aRT of BIPOP-CMA-ES to 1e-7, BBOB-2009, 15 of 15 runs; 0: not looked up
};

// The published numbers are ratio × best aRT of the tables of the COCO data archive (numbbo/ppdata-archive, bbob/2009
// and bbob-noisy/2009, pptables.html). Those of f15 in 20-D and f104 in 20-D are given there with two digits.
const std::vector<Case> kCases{
    {1, 10, 100000, false, 1328},     {8, 10, 1000000, false, 6191},     {10, 10, 100000, false, 5815},
    {15, 10, 3000000, false, 105320}, {17, 10, 3000000, false, 26503},   {1, 20, 100000, false, 2467},
    {8, 20, 1000000, false, 20686},   {10, 20, 200000, false, 19356},    {15, 20, 6000000, false, 460000},
    {17, 20, 3000000, false, 109010}, {101, 10, 1000000, false, 1389},   {101, 10, 1000000, true, 1389},
    {104, 10, 2000000, false, 26240}, {104, 10, 2000000, true, 26240},   {107, 10, 1000000, false, 14303},
    {107, 10, 1000000, true, 14303},  {104, 20, 4000000, false, 310000}, {104, 20, 4000000, true, 310000},
    {107, 20, 2000000, false, 65052}, {107, 20, 2000000, true, 65052},
};

struct Run {
  std::optional<Index> hits[2];  // evaluations until each target
  Index evaluations = 0;
};

struct Reached {};

/// The objective of a run, which ends it by an exception when the last target is reached.
class Counted {
 public:
  Counted(const bbob::Function& f, std::uint64_t seed, Run& run) : f_(f), seed_(seed), run_(run) {}

  void operator()(const ConstMatrixView& X, std::uint64_t first, Index samples, VectorView values) const {
    for (Index j = 0; j < X.cols(); ++j) {
      const double exact = f_(X.col(j));
      double sum = 0;
      for (Index k = 0; k < samples; ++k) {
        Rng rng({.seed = seed_,
                 .candidate = first + static_cast<std::uint64_t>(j),
                 .particle = static_cast<std::uint64_t>(k)});
        ++run_.evaluations;
        record(exact);
        sum += f_.has_noise() ? f_.noisy(exact, rng) : exact;
      }
      values(j) = -sum / static_cast<double>(samples);
    }
  }

 private:
  void record(double exact) const {
    for (int t = 0; t < 2; ++t)
      if (exact < kTargets[t] && !run_.hits[t]) run_.hits[t] = run_.evaluations;
    if (run_.hits[1]) throw Reached{};
  }

  const bbob::Function& f_;
  std::uint64_t seed_;
  Run& run_;
};

/// One run: start uniform in [−4, 4]^n, first step 2, as in Hansen 2009.
Run run_once(const Case& c, std::uint64_t seed) {
  const bbob::Function f(c.function, c.dimension, static_cast<int>(seed));
  optim::SearchOptions options{.max_evaluations = c.max_evaluations, .step = 0.2};
  options.uncertainty.enabled = c.uncertainty;
  options.cmaes.elitism = c.uncertainty;
  if (f.has_noise()) options.cmaes.value_tolerance = 1e-10;
  Rng rng({.seed = seed, .purpose = Purpose::start_state});
  const Vector start = Vector::NullaryExpr(c.dimension, [&] { return rng.uniform(-4, 4); });
  Run run;
  try {
    optim::maximise(Counted(f, seed, run), start, std::vector<Interval>(start.size(), {-5, 5}), options,
                    {.seed = seed, .purpose = Purpose::search});
  } catch (const Reached&) {
  }
  return run;
}

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

nlohmann::json run_case(const Case& c, int seeds) {
  const auto start = Clock::now();
  std::vector<Run> runs;
  for (int seed = 1; seed <= seeds; ++seed) runs.push_back(run_once(c, static_cast<std::uint64_t>(seed)));
  nlohmann::json row{{"function", c.function},
                     {"name", bbob::name_of(c.function)},
                     {"dimension", c.dimension},
                     {"uncertainty_handling", c.uncertainty},
                     {"runs", seeds},
                     {"max_evaluations", c.max_evaluations}};
  if (c.published > 0) row["published_ert_1e-7"] = c.published;
  Index evaluations = 0;
  for (const Run& run : runs) evaluations += run.evaluations;
  for (int t = 0; t < 2; ++t) {
    double spent = 0;
    int solved = 0;
    for (const Run& run : runs) {
      solved += run.hits[t].has_value();
      spent += static_cast<double>(run.hits[t].value_or(run.evaluations));
      row["evaluations"][t].push_back(run.hits[t] ? nlohmann::json(*run.hits[t]) : nlohmann::json());
    }
    const std::string target = t == 0 ? "1e-7" : "1e-8";
    row["solved_" + target] = solved;
    row["ert_" + target] = solved > 0 ? nlohmann::json(spent / solved) : nlohmann::json();
  }
  row["microseconds_per_evaluation"] = 1e6 * seconds_since(start) / static_cast<double>(evaluations);
  return row;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Seconds to renew the root of a covariance matrix; the least of several, since others may use the machine.
double root_seconds(Index n, optim::Root kind) {
  optim::Covariance covariance(n, kind);
  covariance.update(0.9, 0.1 * Matrix::Random(n, n), Matrix(n, 0));
  double least = 1e9;
  for (int i = 0; i < (n < 200 ? 100 : 5); ++i) {
    const auto start = Clock::now();
    covariance.decompose();
    least = std::min(least, seconds_since(start));
  }
  return least;
}

/// Seconds of a generation without the objective and without renewing the root: the median.
double generation_seconds(Index n, Index population, int generations) {
  optim::Cmaes cmaes(Vector::Zero(n), 1, std::vector<Interval>(static_cast<std::size_t>(n), {-5, 5}),
                     {.population = population}, {.purpose = Purpose::search});
  Vector values(population);
  std::vector<double> spent;
  for (int g = 0; g < generations; ++g) {
    const auto asked = Clock::now();
    const Matrix& X = cmaes.ask();
    double seconds = seconds_since(asked);
    values = -(X.array() - 1).square().colwise().sum();
    const auto told = Clock::now();
    cmaes.tell(values);
    spent.push_back(seconds + seconds_since(told));
  }
  return median(spent);
}

nlohmann::json time_generations(Index n, Index population, int generations) {
  const optim::StrategyConstants constants(n, population, true);
  const double gap = std::max(1.0, std::ceil(0.5 / (static_cast<double>(n) * (constants.c_1 + constants.c_mu))));
  const optim::Root kind = n <= optim::CmaesOptions{}.eigen_up_to ? optim::Root::eigen : optim::Root::cholesky;
  const double root = root_seconds(n, kind), generation = generation_seconds(n, population, generations) + root / gap;
  return {{"dimension", n},
          {"population", population},
          {"generation_ms", 1e3 * generation},
          {"root", kind == optim::Root::eigen ? "eigen" : "cholesky"},
          {"root_ms", 1e3 * root},
          {"root_every_generations", gap},
          {"root_share", root / gap / generation},
          {"eigendecomposition_ms", 1e3 * root_seconds(n, optim::Root::eigen)}};
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string count(const nlohmann::json& value) {
  return value.is_number() ? fmt::format("{:.0f}", value.get<double>()) : "–";
}

std::string table(const nlohmann::json& report) {
  std::string text = fmt::format(
      "# Black-box search on BBOB functions\n\nBIPOP-CMA-ES of rehearse::optim::maximise: active update, box [−5, 5], "
      "start uniform in [−4, 4], first σ 2. {} runs a row, one on each official instance from 1. ERT is the expected "
      "number of evaluations to a target: all evaluations spent, divided by the runs that reached it. The last column "
      "is "
      "BIPOP-CMA-ES of Hansen in BBOB-2009, to 1e-7, all runs solved (COCO data archive, bbob/2009 and "
      "bbob-noisy/2009, "
      "pptables.html); it had neither active update nor uncertainty handling. UH: uncertainty handling with "
      "elitism.\n\n"
      "Processor: {} (kernels for {}), one thread. Commit: {}. Command: `{}`.\n\n"
      "| function | n | UH | solved to 1e-8 | ERT to 1e-8 | ERT to 1e-7 | published to 1e-7 | ratio |\n"
      "|---|---|---|---|---|---|---|---|\n",
      report["runs"].get<int>(), report["processor"].get<std::string>(), report["kernels"].get<std::string>(),
      report["commit"].get<std::string>(), report["command"].get<std::string>());
  for (const auto& row : report["cases"]) {
    const auto published = row.value("published_ert_1e-7", 0.0);
    const bool comparable = published > 0 && row["ert_1e-7"].is_number();
    text += fmt::format("| f{} {} | {} | {} | {}/{} | {} | {} | {} | {} |\n", row["function"].get<int>(),
                        row["name"].get<std::string>(), row["dimension"].get<int>(),
                        row["uncertainty_handling"].get<bool>() ? "yes" : "", row["solved_1e-8"].get<int>(),
                        row["runs"].get<int>(), count(row["ert_1e-8"]), count(row["ert_1e-7"]),
                        published > 0 ? fmt::format("{:.0f}", published) : "–",
                        comparable ? fmt::format("{:.2f}", row["ert_1e-7"].get<double>() / published) : "–");
  }
  text +=
      "\n## Cost of a generation, without the objective\n\nMedians and minima; the machine may be shared.\n\n"
      "| n | λ | generation | root of C | its cost | every | share | an eigendecomposition would cost |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const auto& t : report["timing"])
    text +=
        fmt::format("| {} | {} | {:.3f} ms | {} | {:.3f} ms | {:.0f} generations | {:.0f} % | {:.2f} ms |\n",
                    t["dimension"].get<int>(), t["population"].get<int>(), t["generation_ms"].get<double>(),
                    t["root"].get<std::string>(), t["root_ms"].get<double>(), t["root_every_generations"].get<double>(),
                    100 * t["root_share"].get<double>(), t["eigendecomposition_ms"].get<double>());
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  bool quick = false;
  std::string out, commit = "unknown", command = "bbob";
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--quick") quick = true;
    if (argument == "--out" && i + 1 < argc) out = argv[++i];
    if (argument == "--commit" && i + 1 < argc) commit = argv[++i];
  }
  if (quick) command += " --quick";
  if (const std::string wrong = bbob::self_check(); !wrong.empty()) {
    std::cerr << wrong;
    return 1;
  }
  const int seeds = quick ? 1 : 15;
  nlohmann::json report{{"processor", processor()},
                        {"kernels", kernel_target()},
                        {"commit", commit},
                        {"command", command},
                        {"runs", seeds}};
  for (const Case& c : kCases) {
    if (quick && (c.dimension > 10 || c.published > 30000)) continue;
    report["cases"].push_back(run_case(c, seeds));
    const auto& row = report["cases"].back();
    std::cerr << fmt::format("f{} {}-D{}: {}/{} solved, ERT {}\n", c.function, c.dimension, c.uncertainty ? " UH" : "",
                             row["solved_1e-8"].get<int>(), seeds, count(row["ert_1e-8"]));
  }
  report["timing"] = {time_generations(20, 12, 2000), time_generations(81, 17, 2000), time_generations(81, 34, 2000),
                      time_generations(1400, 25, quick ? 20 : 200), time_generations(1400, 100, quick ? 20 : 100)};
  std::cout << table(report);
  if (out.empty()) return 0;
  std::ofstream(out + "/bbob.md") << table(report);
  std::ofstream(out + "/bbob.json") << report.dump(1) << '\n';
}
