#include <utility>

#include <gtest/gtest.h>

#include "naive.hpp"
#include "rehearse/gp/fit.hpp"

namespace rehearse::gp {
namespace {

TEST(FitStop, MayComeBeforeEachEvaluation) {
  struct Stopped {};
  const Inputs inputs(naive::normals(500, 2, 1));
  const Vector y = naive::normals(500, 1, 2).col(0);
  for (const Index part_rows : {0, 200}) {
    Index evaluations = 0;
    FitOptions options;
    options.part_rows = part_rows;
    options.before_each = [&] { ++evaluations; };
    fit(inputs, y, 1, default_start(inputs, y, 1), options);
    const Index all = std::exchange(evaluations, 0);
    options.before_each = [&] {
      if (++evaluations == all) throw Stopped();
    };
    EXPECT_THROW(fit(inputs, y, 1, default_start(inputs, y, 1), options), Stopped);
    EXPECT_EQ(evaluations, all);
  }
}

}  // namespace
}  // namespace rehearse::gp
