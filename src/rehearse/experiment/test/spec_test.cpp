#include "rehearse/experiment/spec.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::experiment {
namespace {

TEST(Spec, EndsWithItsTrialsOrWithOneThatSolves) {
  Spec spec{.trials = 3};
  EXPECT_FALSE(spec.ends_with(2, true));
  EXPECT_TRUE(spec.ends_with(3, false));
  spec.until_solved = true;
  EXPECT_TRUE(spec.ends_with(2, true));
  EXPECT_FALSE(spec.ends_with(2, false));
}

TEST(Spec, NamesItsRun) {
  Spec spec{.scenario = "line", .learner = "echo", .prior = "near,far", .seed = 7};
  EXPECT_EQ(run_name(spec), "line-echo-near,far-7");
  EXPECT_EQ(run_name(spec, "a/b c:ü"), "line-echo-near,far-a_b_c___-7");
  spec.prior.clear();
  EXPECT_EQ(run_name(spec), "line-echo-none-7");
  spec.prior = "../../p/q";
  EXPECT_EQ(run_name(spec), "line-echo-.._.._p_q-7");
}

TEST(Spec, ThePolicyThatItBeginsWithIsANumberAfterTheOther) {
  const Vector theta{{0.1, -3, 1e-17}};
  EXPECT_EQ(start_text(theta), "0.1 -3 1e-17");
  EXPECT_EQ(start_of(start_text(theta)), theta);
  for (const char* wrong : {"", " ", "1 two", "1 nan", "inf"}) EXPECT_EQ(start_of(wrong), std::nullopt) << wrong;
}

TEST(Spec, OptionsOfAFileComeBehindItsOwn) {
  const Spec spec = with_options({.options = {{"a", "1"}}}, {{"b", "2", 5}, {"a", "3", 6}});
  EXPECT_EQ(spec.options, (std::vector<std::pair<std::string, std::string>>{{"a", "1"}, {"b", "2"}, {"a", "3"}}));
}

TEST(Spec, SeedsAreThoseThatSurviveEveryFileFormat) {
  Spec spec;
  const Fields fields = [&](FieldVisitor& v) { spec.fields(v); };
  EXPECT_TRUE(set_field(fields, "seed", "9007199254740992"));
  EXPECT_EQ(spec.seed, 9007199254740992);
  EXPECT_THROW(set_field(fields, "seed", "9007199254740994"), InvalidInput);
  EXPECT_THROW(set_field(fields, "seed", "-1"), InvalidInput);
}

}  // namespace
}  // namespace rehearse::experiment
