#include "rehearse/testing/check_ode_kernel.hpp"

#include <gtest/gtest.h>
#include <hwy/highway.h>

namespace rehearse::testing {
namespace {

void nothing() {}

/// The work of Highway's chooser.
void choose() { hwy::GetChosenTarget().Update(hwy::SupportedTargets()); }

template <void (*call)()>
system::OdeKernel kernel() {
  return {.states = 2,
          .actions = 1,
          .parameters = 1,
          .derivative = [](const double*, const double*, const double*, double*) { call(); },
          .change = [](const ConstMatrixView&, const ConstMatrixView&, const double*, double, Index,
                       MatrixView) { call(); }};
}

TEST(CheckOdeKernel, FindsOneThatChoosesItsInstructionSetAtEveryCall) {
  EXPECT_EQ(check_ode_kernel(kernel<nothing>), std::vector<std::string>{});
  EXPECT_EQ(check_ode_kernel(kernel<choose>),
            (std::vector<std::string>{"derivative chooses the instruction set anew at every call",
                                      "change chooses the instruction set anew at every call"}));
}

}  // namespace
}  // namespace rehearse::testing
