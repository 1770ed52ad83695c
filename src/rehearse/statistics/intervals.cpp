#include "rehearse/statistics/intervals.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <boost/math/special_functions/beta.hpp>

#include "rehearse/core/random.hpp"

namespace rehearse::statistics {
namespace {

constexpr double kTail = (1 - kConfidence) / 2;
constexpr std::size_t kAllSubsetsUpTo = 14;  // values
constexpr std::size_t kSubsets = (std::size_t{1} << kAllSubsetsUpTo) - 1;

/// Between the k-th smallest and the k-th largest (from 1), or everything if k = 0.
Interval order_statistics(std::vector<double> values, std::size_t k) {
  if (k == 0) return {-kInf, kInf};
  std::sort(values.begin(), values.end());
  return {values[k - 1], values[values.size() - k]};
}

/// The largest k for which P(Binomial(n, ½) < k) ≤ tail.
std::size_t sign_test_rank(std::size_t n) {
  double below = 0;
  for (std::size_t k = 0; k <= n; ++k) {
    const auto N = static_cast<double>(n), K = static_cast<double>(k);
    below += std::exp(std::lgamma(N + 1) - std::lgamma(K + 1) - std::lgamma(N - K + 1) - N * std::log(2.0));
    if (below > kTail) return k;
  }
  return 0;
}

std::vector<double> all_subset_means(const std::vector<double>& values) {
  std::vector<double> sums(std::size_t{1} << values.size(), 0.0), means;
  for (std::size_t subset = 1; subset < sums.size(); ++subset) {
    const auto lowest = static_cast<std::size_t>(std::countr_zero(subset));
    sums[subset] = sums[subset & (subset - 1)] + values[lowest];
    means.push_back(sums[subset] / std::popcount(subset));
  }
  return means;
}

double random_subset_mean(const std::vector<double>& values, Rng& rng) {
  double sum = 0;
  std::size_t size = 0;
  while (size == 0) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < values.size(); ++i, bits >>= 1) {
      if (i % 64 == 0) bits = rng();
      if ((bits & 1) == 0) continue;
      sum += values[i];
      ++size;
    }
  }
  return sum / static_cast<double>(size);
}

std::vector<double> subset_means(const std::vector<double>& values) {
  if (values.size() <= kAllSubsetsUpTo) return all_subset_means(values);
  Rng rng({.purpose = Purpose::resampling});
  std::vector<double> means(kSubsets);
  for (double& mean : means) mean = random_subset_mean(values, rng);
  return means;
}

}  // namespace

Interval rate_interval(Index successes, Index runs) {
  const auto k = static_cast<double>(successes), n = static_cast<double>(runs);
  return {successes == 0 ? 0 : boost::math::ibeta_inv(k, n - k + 1, kTail),
          successes == runs ? 1 : boost::math::ibeta_inv(k + 1, n - k, 1 - kTail)};
}

Rate rate(Index count, Index of) { return {count, of, rate_interval(count, of)}; }

Index runs_to_exclude(double probability) {
  return static_cast<Index>(std::ceil(std::log(kTail) / std::log1p(-probability)));
}

Interval median_interval(std::vector<double> values) {
  const std::size_t rank = sign_test_rank(values.size());
  return order_statistics(std::move(values), rank);
}

Interval mean_interval(const std::vector<double>& values) {
  const std::vector<double> means = subset_means(values);
  const auto rank = static_cast<std::size_t>(kTail * static_cast<double>(means.size() + 1));
  return order_statistics(means, rank);
}

}  // namespace rehearse::statistics
