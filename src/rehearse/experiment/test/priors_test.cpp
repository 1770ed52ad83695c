#include "rehearse/experiment/priors.hpp"

#include <gtest/gtest.h>

#include "specs.hpp"

namespace rehearse::experiment {
namespace {

using specs::complaint, specs::Options, specs::spec_of;

TEST(WithoutPrior, LeavesOutTheNameOfThatPriorAlone) {
  EXPECT_EQ(without_prior("prior.near.gain", "near"), "prior.gain");
  EXPECT_EQ(without_prior("prior.far.gain", "near"), "prior.far.gain");
  EXPECT_EQ(without_prior("prior.gain", "near"), "prior.gain");
  EXPECT_EQ(without_prior("noise", "near"), "noise");
}

TEST(ChosenPriors, ANameIsSetInEveryPriorThatHasIt) {
  Violations violations;
  ChosenPriors chosen(fake::LineBuilder().build(), {"near", "far"}, violations);
  chosen.set("gain", "2", violations);
  chosen.set("far.drift", "0.5", violations);
  EXPECT_TRUE(violations.empty());
  EXPECT_EQ(
      chosen.values(),
      (Options{
          {"prior.near.gain", "2"}, {"prior.near.drift", "0"}, {"prior.far.gain", "2"}, {"prior.far.drift", "0.5"}}));
  chosen.set("gain", "much", violations);
  EXPECT_EQ(violations.list(), std::vector<std::string>{"prior.gain = much, must be a number"});
}

TEST(ChosenPriors, TheOneOfAChoiceIsShownByItsName) {
  EXPECT_EQ(phi_text("near,far", 0, 1), "far");
  EXPECT_EQ(phi_text("near,far", 1, 1), "1");
  EXPECT_EQ(phi_text("near", 0, 0.123456), "0.1235");
}

TEST(ChosenPriors, AreNoneOneOrAChoice) {
  const scenario::Scenario line = fake::LineBuilder().build();
  Violations violations;
  EXPECT_FALSE(ChosenPriors(line, {}, violations).prior());
  EXPECT_EQ(ChosenPriors(line, {"far"}, violations).prior()->name, "far");
  EXPECT_GE(ChosenPriors(line, {"far", "near"}, violations).prior()->space.find("prior"), 0);
  EXPECT_EQ(split_names("near,far"), (std::vector<std::string>{"near", "far"}));
  EXPECT_TRUE(split_names("").empty());
}

TEST(ChosenPriors, TheOracleIsFixedAndCannotBeChanged) {
  const Resolved resolved = resolve(fake::catalogue(), spec_of("echo", "oracle"));
  EXPECT_FALSE(resolved.prior->space.has_tunable());
  EXPECT_EQ(complaint(spec_of("echo", "oracle", {{"prior.gain", "2"}})),
            "prior.gain: the oracle is the plant's own dynamics, set plant.gain instead");
}

TEST(ChosenPriors, SeveralAreOneChoice) {
  const Resolved resolved = resolve(fake::catalogue(), spec_of("echo", "near,far", {{"prior.far.gain", "3.5"}}));
  EXPECT_EQ(resolved.spec.prior, "near,far");
  EXPECT_GE(resolved.prior->space.find("prior"), 0);
  EXPECT_EQ(resolved.spec.options[5], (std::pair<std::string, std::string>{"prior.near.gain", "1.2"}));
  EXPECT_EQ(resolved.spec.options[7], (std::pair<std::string, std::string>{"prior.far.gain", "3.5"}));
}

}  // namespace
}  // namespace rehearse::experiment
