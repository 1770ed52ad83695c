#include "rehearse/policy/exported.hpp"

#include <gtest/gtest.h>

#include "exported_fixture.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::policy {
namespace {

TEST(Exported, HasTheAnswersOfThePolicy) {
  for (const exports::Case& each : exports::cases()) {
    const Exported exported = exports::exported(each, exports::asked(5, 0.1));
    Matrix U(1, each.policy->actions());
    each.policy->act(each.theta.transpose(), exported.answers.states.middleRows(4, 1), exported.answers.times_s(4), U);
    EXPECT_EQ(exported.answers.actions.row(4), U.row(0)) << each.name;
    EXPECT_EQ(exported.kind, each.policy->name());
  }
}

TEST(Exported, QuestionsOfOtherSizesAreRefused) {
  const exports::Case of = exports::cases().front();
  Answers wrong = exports::asked(5, 0.1);
  wrong.times_s.conservativeResize(2);
  EXPECT_THROW(exports::exported(of, wrong), InvalidInput);
  wrong = {.states = Matrix::Zero(5, 2), .times_s = Vector::Zero(5), .actions = {}};
  EXPECT_THROW(exports::exported(of, wrong), InvalidInput);
}

TEST(Exported, AtAnotherThetaIsWhatItWouldHaveBeen) {
  for (exports::Case each : exports::cases()) {
    const Exported first = exports::exported(each, exports::asked(5, 0.1));
    each.theta = 0.5 * each.theta;
    const Exported other = with_theta(first, *each.policy, each.theta);
    EXPECT_EQ(to_json(other), to_json(exports::exported(each, exports::asked(5, 0.1)))) << each.name;
    EXPECT_THROW(with_theta(first, *each.policy, Vector::Zero(each.theta.size() + 1)), InvalidInput);
  }
}

TEST(Exported, IsKnownByItsText) {
  const Exported exported = exports::exported(exports::cases().front(), exports::asked(1, 0.1));
  for (const std::string& text : {to_c(exported, "a_name"), to_json(exported), to_numpy(exported)})
    EXPECT_TRUE(is_exported(text)) << text;
  EXPECT_FALSE(is_exported("{}"));
  EXPECT_FALSE(is_exported(""));
}

TEST(Identifier, HasLettersDigitsAndUnderlines) {
  EXPECT_EQ(identifier("arm"), "arm");
  EXPECT_EQ(identifier("my-arm 2"), "my_arm_2");
  EXPECT_EQ(identifier("3rd"), "policy_3rd");
  EXPECT_EQ(identifier(""), "policy_");
  EXPECT_EQ(identifier("é"), "__");
}

}  // namespace
}  // namespace rehearse::policy
