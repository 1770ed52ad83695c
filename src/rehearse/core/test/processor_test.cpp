#include "rehearse/core/processor.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace rehearse {
namespace {

TEST(Processor, TellsTheInstructionSetOfKernels) {
  const std::string target = kernel_target();
  EXPECT_TRUE(target == "AVX2" || target == "AVX3") << target;
}

// Blocks of Eigen's products follow these sizes, and sums the blocks.
TEST(Processor, FixesTheBlocksOfEigensProducts) {
  require_processor();
  EXPECT_EQ(Eigen::l1CacheSize(), 32 << 10);
  EXPECT_EQ(Eigen::l2CacheSize(), 256 << 10);
  EXPECT_EQ(Eigen::l3CacheSize(), 2 << 20);
}

}  // namespace
}  // namespace rehearse
