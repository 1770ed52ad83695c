#include "rehearse/core/pool.hpp"

#include <gtest/gtest.h>

namespace rehearse {
namespace {

TEST(Pool, GivesWhatWasGivenBack) {
  Pool<int> pool;
  EXPECT_EQ(pool.take(), nullptr);
  pool.give_back(nullptr);
  EXPECT_EQ(pool.take(), nullptr);
  auto first = std::make_unique<int>(1), second = std::make_unique<int>(2);
  const int *a = first.get(), *b = second.get();
  pool.give_back(std::move(first));
  pool.give_back(std::move(second));
  const auto c = pool.take(), d = pool.take();
  EXPECT_TRUE((c.get() == a && d.get() == b) || (c.get() == b && d.get() == a));
  EXPECT_EQ(pool.take(), nullptr);
}

}  // namespace
}  // namespace rehearse
