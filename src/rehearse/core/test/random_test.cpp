#include "rehearse/core/random.hpp"

#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse {
namespace {

constexpr StreamKey kKey{.seed = 7,
                         .trial = 3,
                         .phase = Phase::prior,
                         .stage = Stage::solving_search,
                         .search = 5,
                         .purpose = Purpose::simulated_start,
                         .descent = 9,
                         .candidate = 11,
                         .particle = 13};

// Computed by an implementation of Philox4x64-10 in Python that agrees with the known answers of Salmon 2011.
TEST(Random, StreamsAreThoseOfPhilox) {
  Rng rng(kKey);
  for (const std::uint64_t expected : {0x80c9cba2551137e2ull, 0x4f9ff9fd8497c797ull, 0x6a0d7cc9aadfd8afull,
                                       0x18507ef528d5a1acull, 0x942b949417c4c055ull})
    EXPECT_EQ(rng(), expected);
}

TEST(Random, NormalsAreThoseOfPhiloxAndBoxMuller) {
  const std::uint64_t candidate = 11, particle = 13;
  Matrix normals(1, 5);
  fill_normals(kKey, &candidate, &particle, 5, normals);
  const double expected[] = {-0.006425184630158003, 0.8816593059588597, -0.4996341026645103, 0.7528412816828185,
                             0.8939033087294563};
  for (Index c = 0; c < 5; ++c) EXPECT_NEAR(normals(0, c), expected[c], 1e-13);
}

/// kKey, and every key that differs from it in one field.
std::vector<StreamKey> neighbours() {
  std::vector<StreamKey> keys(10, kKey);
  ++keys[1].seed, ++keys[2].trial, ++keys[3].candidate, ++keys[4].particle, keys[5].purpose = Purpose::search;
  keys[6].phase = Phase::robot, keys[7].stage = Stage::judging, ++keys[8].search, ++keys[9].descent;
  return keys;
}

TEST(Random, EveryPartOfTheKeyMatters) {
  std::set<std::uint64_t> first;
  for (const StreamKey& key : neighbours()) first.insert(Rng(key)());
  EXPECT_EQ(first.size(), neighbours().size());
}

// 10 000 normals a stream, 45 pairs: one correlation is beyond 5 standard errors with a probability of 3e-5.
TEST(Random, StreamsThatDifferInOneFieldAreIndependent) {
  constexpr Index kNumbers = 10000;
  Matrix numbers(kNumbers, 10);
  for (Index s = 0; s < numbers.cols(); ++s) {
    Rng rng(neighbours()[static_cast<std::size_t>(s)]);
    for (double& number : numbers.col(s)) number = rng.normal();
  }
  const Matrix correlations = numbers.transpose() * numbers / static_cast<double>(kNumbers);
  for (Index i = 0; i < 10; ++i)
    for (Index j = 0; j < i; ++j) EXPECT_LT(std::abs(correlations(i, j)), 0.05) << i << " and " << j;
}

TEST(Random, RefusesAFieldThatIsTooWide) {
  EXPECT_THROW(Rng({.trial = std::uint64_t{1} << 32}), InvalidInput);
  EXPECT_THROW(Rng({.search = 1 << 16}), InvalidInput);
  EXPECT_THROW(Rng({.descent = std::uint64_t{1} << 32}), InvalidInput);
  EXPECT_NO_THROW(Rng({.trial = 0xffffffff, .search = 0xffff, .descent = 0xffffffff, .candidate = ~std::uint64_t{0}}));
}

TEST(Random, OpenedStreamsCanBeObserved) {
  std::vector<std::pair<StreamKey, std::optional<std::uint64_t>>> seen;
  const std::uint64_t candidates[] = {4, 5}, particles[] = {6, 7};
  Matrix normals(2, 3);
  {
    const ObservedStreams observed(
        [&](const StreamKey& key, std::optional<std::uint64_t> step) { seen.emplace_back(key, step); });
    Rng rng(kKey);
    fill_normals(kKey, candidates, particles, 8, normals);
  }
  Rng unobserved(kKey);
  ASSERT_EQ(seen.size(), 3u);
  EXPECT_EQ(seen[0].first, kKey);
  EXPECT_FALSE(seen[0].second);
  EXPECT_EQ(seen[2].first.candidate, 5u);
  EXPECT_EQ(seen[2].first.particle, 7u);
  EXPECT_EQ(seen[2].second, 8u);
}

TEST(Random, ACopyGoesOnAlike) {
  Rng rng(kKey);
  rng.normal();  // leaves a spare one
  Rng copy = rng;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(rng.normal(), copy.normal());
}

struct Moments {
  double mean = 0, variance = 0, fourth = 0;
};
template <class Draw>
Moments moments(int n, Draw draw) {
  Moments m;
  for (int i = 0; i < n; ++i) {
    const double x = draw();
    m.mean += x / n, m.variance += x * x / n, m.fourth += x * x * x * x / n;
  }
  m.variance -= m.mean * m.mean;
  return m;
}

// Seed 7, n = 100 000. Deviations of mean, variance and fourth moment of N(0, 1): 1, √2 and √96 over √n; the bounds
// are 5 of them: false-alarm probability 6e-7 each.
constexpr int kDraws = 100000;
const double kFiveDeviations = 5 / std::sqrt(kDraws);

void expect_normal(const Moments& m) {
  EXPECT_LT(std::abs(m.mean), kFiveDeviations);
  EXPECT_LT(std::abs(m.variance - 1), kFiveDeviations * std::sqrt(2));
  EXPECT_LT(std::abs(m.fourth - 3), kFiveDeviations * std::sqrt(96));
}

TEST(Random, NormalHasTheMomentsOfNormals) {
  Rng rng(kKey);
  expect_normal(moments(kDraws, [&] { return rng.normal(); }));
}

TEST(Random, FillNormalsHasThemInEveryColumn) {
  std::vector<std::uint64_t> candidates(kDraws), particles(kDraws, 0);
  for (int i = 0; i < kDraws; ++i) candidates[static_cast<std::size_t>(i)] = static_cast<std::uint64_t>(i);
  Matrix normals(kDraws, 3);
  fill_normals(kKey, candidates.data(), particles.data(), 0, normals);
  EXPECT_TRUE(normals.allFinite());
  for (Index c = 0; c < 3; ++c) {
    Index i = 0;
    expect_normal(moments(kDraws, [&] { return normals(i++, c); }));
    for (Index other = 0; other < c; ++other)
      EXPECT_LT(std::abs(normals.col(c).dot(normals.col(other)) / kDraws), kFiveDeviations);
  }
}

// The same moments; a uniform has mean 1/2, variance 1/12, and its square deviation a deviation of √(1/180).
TEST(Random, UniformIsUniform) {
  Rng rng(kKey);
  double low = 1, high = 0;
  const Moments m = moments(kDraws, [&] {
    const double u = rng.uniform();
    low = std::min(low, u), high = std::max(high, u);
    return u - 0.5;
  });
  EXPECT_LT(std::abs(m.mean), kFiveDeviations / std::sqrt(12));
  EXPECT_LT(std::abs(m.variance - 1.0 / 12), kFiveDeviations / std::sqrt(180));
  EXPECT_GE(low, 0);
  EXPECT_LT(high, 1);
  for (int i = 0; i < 1000; ++i) {
    const double u = rng.uniform(-3, 5);
    EXPECT_TRUE(u >= -3 && u < 5);
  }
}

// n = 70 000 in 7 cells: χ² with 6 degrees of freedom exceeds 38.3 with probability 1e-6.
TEST(Random, BelowIsUniformOnItsRange) {
  Rng rng(kKey);
  double counts[7] = {};
  for (int i = 0; i < 70000; ++i) ++counts[rng.below(7)];
  double chi_squared = 0;
  for (const double count : counts) chi_squared += (count - 10000) * (count - 10000) / 10000;
  EXPECT_LT(chi_squared, 38.3);
  EXPECT_EQ(rng.below(1), 0);
}

TEST(FillNormals, ARowDependsOnItsNamesAlone) {
  std::vector<std::uint64_t> candidates, particles;
  for (std::uint64_t i = 0; i < 37; ++i) candidates.push_back(i * i % 11), particles.push_back(i);
  for (const Index columns : {1, 2, 4, 5}) {
    Matrix all(37, columns), one(1, columns);
    fill_normals(kKey, candidates.data(), particles.data(), 2, all);
    for (std::size_t i = 0; i < 37; ++i) {
      fill_normals(kKey, &candidates[i], &particles[i], 2, one);
      EXPECT_EQ(one, all.row(static_cast<Index>(i)));
    }
    Matrix fewer(37, 1);
    fill_normals(kKey, candidates.data(), particles.data(), 2, fewer);
    EXPECT_EQ(fewer.col(0), all.col(0));
  }
}

TEST(FillNormals, StepsDiffer) {
  const std::uint64_t name = 0;
  Matrix first(1, 4), second(1, 4);
  fill_normals(kKey, &name, &name, 0, first);
  fill_normals(kKey, &name, &name, 1, second);
  EXPECT_TRUE((first.array() != second.array()).all());
}

}  // namespace
}  // namespace rehearse
