#include "rehearse/expression/slots.hpp"

#include <cstdint>

#include <gtest/gtest.h>

#include "rehearse/expression/tape_kernel.hpp"

namespace rehearse::expression {
namespace {

TEST(Slots, AreAlignedAndGrow) {
  double* few = slots_of_this_thread(2);
  few[0] = 7;
  EXPECT_EQ(slots_of_this_thread(1), few);
  EXPECT_EQ(few[0], 7) << "and keep what they hold";
  for (const Index slots : {1, 100, 1000}) {
    double* memory = slots_of_this_thread(slots);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % 64, 0u);
    memory[slots * kBlock - 1] = 1;
  }
}

TEST(Slots, AreFilledUpToWholeVectors) {
  double slot[kBlock] = {};
  const double from[] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  load(slot, from, 9);
  EXPECT_EQ(slot[8], 9);
  for (int i = 9; i < 16; ++i) EXPECT_EQ(slot[i], 1);
  EXPECT_EQ(slot[16], 0);
}

}  // namespace
}  // namespace rehearse::expression
