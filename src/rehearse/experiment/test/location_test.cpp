#include "rehearse/experiment/location.hpp"

#include <gtest/gtest.h>

#include "specs.hpp"

namespace rehearse::experiment {
namespace {

using specs::spec_of;

TEST(Location, TheCauseIsTheFirstOptionThatIsWrongWithoutTheOthers) {
  const Catalogue catalogue = fake::catalogue();
  const Spec bare = spec_of("echo", "near");
  const std::vector<FileOption> options = {{"search.step", "2", 7}, {"noise", "-1", 8}, {"noise", "-1", 9}};
  const std::string violation = "noise = -1, must be ≥ 0";
  EXPECT_FALSE(has_violation(catalogue, bare, violation));
  EXPECT_TRUE(has_violation(catalogue, with_options(bare, options), violation));
  const FileOption* found = cause(catalogue, bare, options, violation);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->line, 8);
}

TEST(Location, OptionsThatAViolationNamesAreTriedFirst) {
  int made = 0;
  Catalogue catalogue = fake::catalogue();
  catalogue.scenarios = {{"line", [&made] {
                            ++made;
                            return std::make_unique<fake::LineBuilder>();
                          }}};
  const std::vector<FileOption> options = {
      {"learner.search.step", "2", 1}, {"scenario.breaks", "true", 2}, {"scenario.noise", "-1", 3}};
  const FileOption* found = cause(catalogue, spec_of("echo", "near"), options, "noise = -1, must be ≥ 0");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->line, 3);
  EXPECT_EQ(made, 1) << "a builder for each spec that is resolved";
}

TEST(Location, WhatNoOptionBringsHasNoCauseAmongThem) {
  const std::string violation = "noise = -1, must be ≥ 0";
  const std::vector<FileOption> harmless = {{"noise", "0", 1}, {"noise", "-2", 2}};
  EXPECT_FALSE(cause(fake::catalogue(), spec_of("echo", "near"), harmless, violation));
}

}  // namespace
}  // namespace rehearse::experiment
