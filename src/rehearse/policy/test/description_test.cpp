#include "rehearse/policy/description.hpp"

#include <gtest/gtest.h>

#include "exported_fixture.hpp"
#include "naive_rbf.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::policy {
namespace {

TEST(Describe, NamesWhatThePolicySees) {
  const auto inputs = inputs_of(fixture::features(), fixture::kScale);
  ASSERT_EQ(inputs.size(), 3u);
  EXPECT_EQ(inputs[0].state, 0);
  EXPECT_EQ(inputs[0].scale, 10);
  EXPECT_EQ(inputs[2].state, 1);
  EXPECT_EQ(inputs[2].function, Input::Function::sine);
  EXPECT_THROW(inputs_of(FeatureMap({StateKind::omitted}), Vector(0)), InvalidInput);
  const FeatureMap joints({StateKind::angle, StateKind::angle}, {{1, 0}});
  EXPECT_THROW(inputs_of(joints, Vector::Ones(6)), InvalidInput);
}

TEST(Describe, WeightsOfTheRbfAreSolved) {
  const auto policy = make_rbf({fixture::features(), fixture::kScale, 4, 0.1, fixture::kBounds});
  const Vector theta = fixture::normals(policy->parameters(), 1, 3);
  const auto radial = std::get<Radial>(describe(*policy, theta).form);
  const Vector x{{0.3, -0.2, 0.5}};
  for (Index a = 0; a < 2; ++a) {
    double mean = 0;
    for (Index c = 0; c < 4; ++c) {
      const Vector apart = (x - radial.centres.row(c).transpose()).cwiseQuotient(radial.lengths.row(a).transpose());
      mean += radial.weights(a, c) * std::exp(-0.5 * apart.squaredNorm());
    }
    EXPECT_NEAR(mean, naive::mean(theta, x, {3, 4, 2, 0.1}, a), 1e-11);
  }
}

TEST(Describe, ActionsOfATableAreInTheirBounds) {
  const auto policy = make_schedule({{-1, 1}}, 0.5, 3);
  const auto table = std::get<Table>(describe(*policy, Vector{{-7, 0.5, 2}}).form);
  EXPECT_EQ(table.actions, (Matrix{{-1}, {0.5}, {1}}));
  EXPECT_EQ(table.per_s, 2);
  EXPECT_FALSE(table.periodic);
  EXPECT_TRUE(std::get<Table>(describe(*make_gait(6), tripod_gait()).form).periodic);
}

/// Says nothing of itself.
class Mute final : public Policy {
 public:
  std::string name() const override { return "mute"; }
  Index parameters() const override { return 1; }
  Index actions() const override { return 1; }
  void act(const ConstMatrixView&, const ConstMatrixView&, double, MatrixView U) const override { U.setZero(); }
};

TEST(Describe, SaysWhatIsWrong) {
  EXPECT_THROW(describe(Mute(), Vector::Zero(1)), InvalidInput);
  const auto policy = make_schedule({{-1, 1}}, 0.5, 3);
  EXPECT_THROW(describe(*policy, Vector::Zero(2)), InvalidInput);
  EXPECT_THROW(describe(*policy, Vector{{0, std::nan(""), 0}}), InvalidInput);
}

}  // namespace
}  // namespace rehearse::policy
