#include "rehearse/learners/black_drops/safety.hpp"

#include <set>

#include <gtest/gtest.h>

#include "rehearse/rollout/simulate.hpp"
#include "slider.hpp"

namespace rehearse::learners::black_drops {
namespace {

std::vector<Limit> limits_of(double risk) { return {{.name = "end", .risk = risk}, {.name = "speed", .risk = 0.5}}; }

TEST(Safety, NeedsTheUpperEndOfARiskBelowWhatIsAllowed) {
  EXPECT_EQ(excess({}, {}), 0);
  EXPECT_EQ(excess({{0, 100}, {0, 100}}, limits_of(0.05)), 0);
  EXPECT_GT(excess({{1, 100}, {0, 100}}, limits_of(0.05)), 0) << "one of a hundred may be 5.4 %";
  EXPECT_GT(excess({{2, 100}, {0, 100}}, limits_of(0.05)), excess({{1, 100}, {0, 100}}, limits_of(0.05)));
  EXPECT_EQ(excess({{11, 400}, {100, 400}}, limits_of(0.05)), 0);
  EXPECT_GT(excess({{0, 400}, {220, 400}}, limits_of(0.05)), 0) << "the second limit counts, too";
}

TEST(Safety, WarnsOfEachLimitThatMayBeBrokenTooOften) {
  EXPECT_TRUE(warnings({{0, 400}, {0, 400}}, limits_of(0.05)).empty());
  const auto lines = warnings({{80, 400}, {0, 400}}, limits_of(0.05));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("break the limit end, which allows 5 %"), std::string::npos) << lines[0];
}

TEST(Safety, DoubtsWhatIsTunable) {
  const Task task = slider::task();
  const prior::Prior prior = slider::prior();
  EXPECT_TRUE(doubted(prior, 0, {}).empty());
  EXPECT_TRUE(doubted({prior.name, prior.simulator, prior.space.fixed_at(prior.space.values())}, 1, {}).empty());
  const auto models = doubted(prior, 0.5, {.seed = 1});
  ASSERT_GE(models.size(), 10u);
  Matrix change(1, 1);
  std::vector<double> changes;
  for (const auto& model : models) {
    model->predict_mean(Matrix::Zero(1, 1), Matrix::Ones(1, 1), change);
    changes.push_back(change(0, 0) / task.dt_s);  // about the gain
  }
  // Gains are uniform in 1 + 0.5 ([−2, 2] − 1) = [−0.5, 1.5].
  EXPECT_GT(*std::ranges::min_element(changes), -0.51);
  EXPECT_LT(*std::ranges::max_element(changes), 1.51);
  EXPECT_LT(*std::ranges::min_element(changes), 0.5);
  EXPECT_GT(*std::ranges::max_element(changes), 0.5);
}

TEST(Safety, DoubtsWhichOfSeveralValuesItIs) {
  const prior::Prior prior = learners::slider::prior_in(
      ParameterSpace({Parameter::discrete("gain", 1, {1, 2}), Parameter::fixed("drag", 0.5)}));
  std::set<double> changes;
  Matrix change(1, 1);
  for (const auto& model : doubted(prior, 0.1, {.seed = 1})) {
    model->predict_mean(Matrix::Zero(1, 1), Matrix::Ones(1, 1), change);
    changes.insert(change(0, 0));
  }
  EXPECT_EQ(changes.size(), 2u);
}

}  // namespace
}  // namespace rehearse::learners::black_drops
