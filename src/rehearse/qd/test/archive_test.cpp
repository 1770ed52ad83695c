#include "rehearse/qd/archive.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::qd {
namespace {

Archive four_boxes() { return {Niches(Grid{{{0, 1}, {0, 1}}, {2, 2}}), 3}; }

bool add(Archive& archive, Index niche, double performance, double mark) {
  return archive.add(niche, performance, Vector{{mark, mark}}.data(), Vector{{mark, 0, 0}}.data());
}

TEST(Archive, KeepsTheBestOfEachNiche) {
  Archive archive = four_boxes();
  EXPECT_EQ(archive.best(), -1);
  EXPECT_TRUE(add(archive, 2, 1, 0.1));
  EXPECT_TRUE(add(archive, 0, 3, 0.2));
  EXPECT_FALSE(add(archive, 2, 1, 0.3)) << "as good is not better";
  EXPECT_FALSE(add(archive, 2, -5, 0.3));
  EXPECT_EQ(archive.solution(archive.elite_of(2))(0), 0.1);
  EXPECT_TRUE(add(archive, 2, 4, 0.4));
  ASSERT_EQ(archive.size(), 2);
  EXPECT_EQ(archive.niche(0), 2);
  EXPECT_EQ(archive.niche(1), 0);
  EXPECT_EQ(archive.elite_of(1), -1);
  EXPECT_EQ(archive.performance(0), 4);
  EXPECT_EQ(archive.descriptor(0), (Vector{{0.4, 0.4}}));
  EXPECT_EQ(archive.best(), 0);
}

TEST(Archive, NeverKeepsWhatHasNoNicheOrNoValue) {
  Archive archive = four_boxes();
  EXPECT_FALSE(add(archive, -1, 1, 0));
  for (const double bad : {std::nan(""), kInf, -kInf}) EXPECT_FALSE(add(archive, 0, bad, 0));
  EXPECT_EQ(archive.size(), 0);
}

TEST(Archive, ReadsSolutionsThatAreRows) {
  Archive archive = four_boxes();
  const Matrix X{{1, 2, 3}, {4, 5, 6}};
  archive.add(1, 0, Vector{{0, 0}}.data(), X.data() + 1, X.rows());
  EXPECT_EQ(archive.solution(0), (Vector{{4, 5, 6}}));
}

TEST(Archive, CountsFromTheFloor) {
  Archive archive = four_boxes();
  EXPECT_EQ(archive.statistics(-10).qd_score, 0);
  EXPECT_EQ(archive.statistics().best, -kInf);
  EXPECT_TRUE(std::isnan(archive.statistics().mean));
  add(archive, 3, -4, 0);
  add(archive, 1, 2, 0);
  const Statistics s = archive.statistics(-10);
  EXPECT_EQ(s.filled, 2);
  EXPECT_EQ(s.coverage, 0.5);
  EXPECT_EQ(s.qd_score, 18);
  EXPECT_EQ(s.best, 2);
  EXPECT_EQ(s.mean, -1);
}

TEST(Archive, GrowsBeyondItsFirstRoom) {
  Archive archive(Niches(Grid{{{0, 1}}, {5000}}), 1);
  for (Index niche = 0; niche < 5000; ++niche) {
    const double value = static_cast<double>(niche);
    ASSERT_TRUE(archive.add(4999 - niche, value, &value, &value));
  }
  for (Index niche = 0; niche < 5000; ++niche)
    ASSERT_EQ(archive.solution(archive.elite_of(niche))(0), static_cast<double>(4999 - niche));
  EXPECT_THROW(Archive(Niches(Grid{{{0, 1}}, {2}}), 0), InvalidInput);
}

}  // namespace
}  // namespace rehearse::qd
