#include "rehearse/optim/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "rehearse/optim/median.hpp"
#include "rehearse/optim/usable.hpp"

namespace rehearse::optim {
namespace {

/// Ranks of both evaluations of every candidate among all 2λ, 1 the best. A candidate that was evaluated once stands
/// for both.
struct JointRanks {
  std::vector<double> first, second;

  JointRanks(const ConstVectorView& values, const ConstVectorView& again) {
    const auto n = static_cast<std::size_t>(values.size()), twice = static_cast<std::size_t>(again.size());
    std::vector<double> all(2 * n);
    for (std::size_t i = 0; i < n; ++i) {
      all[2 * i] = usable(values(static_cast<Index>(i)));
      all[2 * i + 1] = i < twice ? usable(again(static_cast<Index>(i))) : all[2 * i];
    }
    std::vector<std::size_t> order(2 * n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return all[a] > all[b]; });
    first.resize(n);
    second.resize(n);
    for (std::size_t r = 0; r < 2 * n; ++r)
      (order[r] % 2 == 0 ? first : second)[order[r] / 2] = static_cast<double>(r + 1);
  }

  double sum(std::size_t i) const { return first[i] + second[i]; }

  /// Ranks that lie between the two evaluations of i, Δ_i of Hansen 2009, eq. 1.
  double change(std::size_t i) const { return std::abs(second[i] - first[i]) - 1; }
};

/// θ times the median change of a value of rank R under pure noise, Hansen 2009, eq. 2.
double limit(double R, double theta, std::size_t population) {
  std::vector<double> changes;
  for (std::size_t k = 1; k < 2 * population; ++k) changes.push_back(std::abs(static_cast<double>(k) - R));
  return theta * upper_median(std::move(changes));
}

/// s of Hansen 2009, eq. 3, for the `count` candidates evaluated twice.
double measure(const JointRanks& ranks, std::size_t count, double theta) {
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double a = ranks.first[i], b = ranks.second[i];
    sum += 2 * ranks.change(i) - limit(b - (b > a), theta, ranks.first.size()) -
           limit(a - (a > b), theta, ranks.first.size());
  }
  return sum / static_cast<double>(count);
}

/// The order by the sum of ranks; then the steadier candidate first (one evaluated once counts as average); then by
/// value.
std::vector<Index> order_of(const JointRanks& ranks, std::size_t count, const ConstVectorView& values) {
  double mean_change = 0;
  for (std::size_t i = 0; i < count; ++i) mean_change += ranks.change(i) / static_cast<double>(count);
  const auto change = [&](std::size_t i) { return i < count ? ranks.change(i) : mean_change; };
  std::vector<Index> order(ranks.first.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    if (ranks.sum(i) != ranks.sum(j)) return ranks.sum(i) < ranks.sum(j);
    if (change(i) != change(j)) return change(i) < change(j);
    return usable(values(a)) > usable(values(b));
  });
  return order;
}

}  // namespace

void UncertaintyOptions::fields(FieldVisitor& v) {
  v.boolean("enabled", enabled, "uncertainty handling (UH-CMA-ES): noise is estimated by re-evaluation",
            published(true));
  v.number("reevaluated", reevaluated, "fraction of the candidates that is evaluated twice", between(0.01, 1),
           published(0.1, "libcmaes"));
  v.integer("reevaluated_least", reevaluated_least, "candidates evaluated twice, at least", between(1, 1e6),
            published(2, "libcmaes"));
  v.number("tolerance", tolerance, "changes of rank that are acceptable, as a fraction of those of pure noise",
           between(0, 1), published(0.2, "libcmaes"));
  v.number("smoothing", smoothing, "weight of the newest measurement of the noise", between(0.01, 1),
           published(1, "libcmaes"));
  v.integer("max_samples", max_samples, "evaluations of a candidate at most; beyond, σ grows", between(1, 1e6),
            published(1, "libcmaes"));
  v.number("samples_growth", samples_growth,
           "growth factor of evaluations while there is too much noise; 0: 1 + 2 / (n + 10)", at_least(0));
  v.number("samples_decay", samples_decay, "exponent of the decay of evaluations, of which samples_growth is the base",
           between(0, 1));
  v.number("sigma_growth", sigma_growth, "growth factor of σ once max_samples is reached; 0: 1 + 2 / (n + 10)",
           at_least(0));
  for (const auto& [name, growth] : {std::pair("samples_growth", samples_growth), {"sigma_growth", sigma_growth}})
    v.require(growth == 0 || growth >= 1, fmt::format("{} = {}, must be ≥ 1, or 0", name, to_text(growth)));
}

UncertaintyHandler::UncertaintyHandler(const UncertaintyOptions& options, Index dimension, Index population)
    : options_(options), population_(population), carried_(options.reevaluated * static_cast<double>(population)) {
  const double growth = 1 + 2 / (static_cast<double>(dimension) + 10);
  if (options_.samples_growth == 0) options_.samples_growth = growth;
  if (options_.sigma_growth == 0) options_.sigma_growth = growth;
}

Index UncertaintyHandler::samples() const { return options_.enabled ? std::lround(real_samples_) : 1; }

Index UncertaintyHandler::reevaluations() const {
  return options_.enabled
             ? std::clamp(static_cast<Index>(carried_), std::min(options_.reevaluated_least, population_), population_)
             : 0;
}

Index UncertaintyHandler::generation_cost() const { return (population_ + reevaluations()) * samples(); }

std::vector<Index> UncertaintyHandler::rank(VectorView values, const ConstVectorView& again, const Vector& penalties) {
  const auto count = static_cast<std::size_t>(again.size());
  const Vector loss = penalties.size() > 0 ? penalties : Vector::Zero(values.size());
  const JointRanks ranks(values - loss, again - loss.head(again.size()));
  uncertainty_ += options_.smoothing * (measure(ranks, count, options_.tolerance) - uncertainty_);
  values.head(again.size()) = (values.head(again.size()) + again) / 2;
  treat();
  const double fraction = options_.reevaluated * static_cast<double>(population_);
  carried_ += fraction - static_cast<double>(again.size());
  carried_ = std::max(carried_, 0.0);
  return order_of(ranks, count, values - loss);
}

// Hansen 2009, section III.C: first more evaluations, then larger steps.
void UncertaintyHandler::treat() {
  const double most = static_cast<double>(options_.max_samples), growth = options_.samples_growth;
  sigma_factor_ = uncertainty_ > 0 && real_samples_ >= most ? options_.sigma_growth : 1;
  if (uncertainty_ > 0)
    real_samples_ = std::clamp(real_samples_ * growth, 1.0, most);
  else
    real_samples_ = std::max(real_samples_ * std::pow(growth, -options_.samples_decay), 1.0);
}

}  // namespace rehearse::optim
