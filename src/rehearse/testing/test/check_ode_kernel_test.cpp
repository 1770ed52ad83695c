#include "rehearse/testing/check_ode_kernel.hpp"

#include <gtest/gtest.h>
#include <hwy/highway.h>

namespace rehearse::testing {
namespace {

void choose() { hwy::GetChosenTarget().Update(hwy::SupportedTargets()); }

system::OdeKernel good() {
  return {[](auto...) {}, [](auto...) {}};
}

/// What Highway's chooser does.
system::OdeKernel choosing() {
  return {[](auto...) { choose(); }, [](auto...) { choose(); }};
}

TEST(CheckOdeKernel, FindsOneThatChoosesItsInstructionSetAtEveryCall) {
  if (hwy::SupportedTargets() == HWY_STATIC_TARGET) GTEST_SKIP() << "there is nothing to choose";
  const Vector x = Vector::Zero(2), phi = Vector::Ones(1);
  EXPECT_EQ(check_ode_kernel(good, x, phi), std::vector<std::string>{});
  EXPECT_EQ(check_ode_kernel(choosing, x, phi),
            (std::vector<std::string>{"derivative chooses the instruction set anew at every call",
                                      "change chooses the instruction set anew at every call"}));
}

}  // namespace
}  // namespace rehearse::testing
