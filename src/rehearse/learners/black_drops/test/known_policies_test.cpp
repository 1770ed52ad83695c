#include "rehearse/learners/black_drops/known_policies.hpp"

#include <map>

#include <gtest/gtest.h>

#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

using slider::builder, slider::setting;

/// The slider's policy, with an example that earns much.
class PolicyWithExample final : public policy::Policy {
 public:
  std::string name() const override { return policy_->name(); }
  Index parameters() const override { return policy_->parameters(); }
  Index actions() const override { return policy_->actions(); }
  Matrix examples() const override { return Matrix{{-5, 0}}; }
  void act(const ConstMatrixView& Theta, const ConstMatrixView& X, double t_s, MatrixView U) const override {
    policy_->act(Theta, X, t_s, U);
  }

 private:
  std::shared_ptr<const policy::Policy> policy_ = slider::policy();
};

TEST(KnownPolicies, AreTheBestTriedThenTheExamples) {
  const History history{
      .policies = {Vector{{1, 0}}, Vector{{2, 0}}, Vector{{3, 0}}}, .returns = {9, 7, 8}, .random_first = true};
  using Policies = std::vector<Vector>;
  Options options;
  EXPECT_EQ(known_policies(history, PolicyWithExample(), options), (Policies{Vector{{3, 0}}, Vector{{-5, 0}}}));
  options.start_from_best = options.start_from_examples = false;
  EXPECT_EQ(known_policies(history, PolicyWithExample(), options), Policies());
}

TEST(KnownPolicies, ARandomFirstTrialIsNeverTheBest) {
  History history{.returns = {9, 7, 8}};
  EXPECT_EQ(history.best(), 0u);
  history.random_first = true;
  EXPECT_EQ(history.best(), 2u);
  history.returns = {9};
  EXPECT_EQ(history.best(), std::nullopt);
  history.returns.clear();
  EXPECT_EQ(history.best(), std::nullopt);
}

TEST(KnownPolicies, AnEpisodeThatWasCutShortIsNeverTheBest) {
  Episode whole{.states = Matrix::Zero(4, 1),
                .true_states = Matrix::Zero(4, 1),
                .actions = Matrix::Zero(3, 1),
                .rewards = Vector::Constant(3, -2)};
  History history;
  history.earn(whole.part(0, 1), 3);
  EXPECT_EQ(history.best(), std::nullopt);
  history.earn(whole, 3);
  EXPECT_EQ(history.returns[1], -6);
  EXPECT_EQ(history.best(), 1u);
}

// The first descent begins at the example, or at a random point, and is cut off before it gets anywhere else.
TEST(KnownPolicies, StartsFromThePolicysExamplesUnlessToldNotTo) {
  const auto first = [](const char* from_examples) {
    const auto with = builder("mi", "64");
    for (const auto& [name, value] : std::map<std::string, std::string>{{"start_from_examples", from_examples},
                                                                        {"search.race.descents", "1"},
                                                                        {"search.race.start_sigma", "1e-6"},
                                                                        {"search.race.sigma", "1e-6"},
                                                                        {"retry.searches", "0"}})
      EXPECT_TRUE(set_field([&](FieldVisitor& v) { with->fields(v); }, name, value));
    Setting own = setting();
    own.policy = std::make_shared<PolicyWithExample>();
    return with->build(own)->ask().theta;
  };
  EXPECT_LT((first("true") - Vector{{-5, 0}}).norm(), 1e-3);
  EXPECT_GT((first("false") - Vector{{-5, 0}}).norm(), 1e-2);
}

// The same from the policy that the run begins with.
TEST(KnownPolicies, SearchesStartFromThePolicyThatTheRunBeginsWith) {
  const auto with = builder("mi", "64");
  for (const auto& [name, value] : std::map<std::string, std::string>{{"search.race.descents", "1"},
                                                                      {"search.race.start_sigma", "1e-6"},
                                                                      {"search.race.sigma", "1e-6"},
                                                                      {"retry.searches", "0"}})
    EXPECT_TRUE(set_field([&](FieldVisitor& v) { with->fields(v); }, name, value));
  Setting own = setting();
  own.start = Vector{{-4, 0.5}};
  EXPECT_TRUE(with->takes_start());
  EXPECT_LT((with->build(own)->ask().theta - *own.start).norm(), 1e-3);
}

TEST(KnownPolicies, WithoutAModelThePolicyThatTheRunBeginsWithIsTriedFirst) {
  Setting own = setting();
  own.prior.reset();
  own.start = Vector{{-4, 0.5}};
  const auto learner = builder("black-drops", "64")->build(own);
  EXPECT_EQ(learner->ask().theta, *own.start);
  EXPECT_EQ(learner->ask().policy, own.policy);
}

}  // namespace
}  // namespace rehearse::learners::black_drops
