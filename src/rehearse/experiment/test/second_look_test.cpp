#include "rehearse/experiment/second_look.hpp"

#include <string>

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::experiment {
namespace {

/// A second look at so many trials of a line on which the cart hardly moves.
SecondLook looked_at(Index trials) {
  const std::filesystem::path folder = fake::test_folder() / ("run-" + std::to_string(trials));
  Spec spec = fake::line_spec(trials);
  spec.options = {{"plant.gain", "0.01"}};
  start_run(fake::catalogue(), spec, folder, {});
  return second_look(fake::catalogue(), folder, {});
}

TEST(SecondLook, IsTakenAfterThreeTrialsThatDidNotSolveTheTask) {
  EXPECT_EQ(looked_at(2).read_on, "");
  EXPECT_NE(looked_at(3).read_on.find("docs/does-not-learn.md"), std::string::npos);
}

TEST(SecondLook, NeedsARunFolder) {
  EXPECT_THROW(second_look(fake::catalogue(), fake::test_folder() / "none", {}), InvalidInput);
}

}  // namespace
}  // namespace rehearse::experiment
