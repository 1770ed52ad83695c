// Making, placing and keeping solutions allocates nothing: a generation of four times the size takes as many
// allocations.

#include <gtest/gtest.h>

#include "rehearse/qd/map_elites.hpp"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include "rehearse/core/test/counted_allocations.hpp"

namespace rehearse::qd {
namespace {

void plain(const ConstMatrixView& X, std::uint64_t, VectorView performances, MatrixView descriptors) {
  performances = X.col(2);
  descriptors = X.leftCols(2);
}

/// The allocations of ten generations, once every niche is filled.
long allocations_of(Index batch, Variation::Kind kind) {
  const Niches niches(Cvt{.bounds = {{0, 1}, {0, 1}}, .niches = 50, .samples = 500});
  MapElites search(Archive(niches, 6), {.box = std::vector<Interval>(6, {0, 1})},
                   {.batch = batch, .variation = {.kind = kind, .iso_sigma = 0.1}}, {});
  for (int g = 0; g < 40; ++g) search.step(plain, serial_evaluator());
  EXPECT_EQ(search.archive().size(), 50);
  const long before = allocations;
  for (int g = 0; g < 10; ++g) search.step(plain, serial_evaluator());
  return allocations - before;
}

TEST(Allocations, NoneForASolution) {
  EXPECT_GT((delete new int(1), allocations.load()), 0) << "the count works";
  for (const auto kind : {Variation::Kind::iso_line, Variation::Kind::gaussian, Variation::Kind::reset})
    EXPECT_EQ(allocations_of(256, kind), allocations_of(1024, kind)) << static_cast<int>(kind);
}

}  // namespace
}  // namespace rehearse::qd

#endif
