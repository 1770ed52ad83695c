#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::prior {
namespace {

/// dX = the sum of its parameters, each times a power of ten: which ones were used can be read off.
class Digits final : public system::Simulator {
 public:
  explicit Digits(ParameterSpace space) : space_(std::move(space)) {}
  const ParameterSpace& parameters() const override { return space_; }
  void change(const ConstMatrixView&, const ConstMatrixView&, const Vector& phi, MatrixView dX) const override {
    double sum = 0;
    for (Index i = 0; i < phi.size(); ++i) sum = 10 * sum + phi(i);
    dX.setConstant(sum);
  }

 private:
  ParameterSpace space_;
};

Parameter tunable(const char* name, double value, Interval box = {0, 9}) {
  return Parameter::continuous(name, value, box);
}

Prior prior(const char* name, std::vector<Parameter> parameters) {
  const ParameterSpace space(std::move(parameters));
  return {name, std::make_shared<Digits>(space), space};
}

double change_of(const Prior& prior, const Vector& phi) {
  Matrix dX(1, 1);
  EXPECT_EQ(prior.mean(Matrix{{0}}, Matrix{{0}}, phi, dX), 0);
  return dX(0, 0);
}

TEST(Choice, SharesParametersOfTheSameNameAndBox) {
  const Prior a = prior("a", {tunable("m", 1), tunable("l", 2)}), b = prior("b", {tunable("l", 3), tunable("m", 4)});
  const Prior both = choice({a, b});
  EXPECT_EQ(both.name, "a,b");
  EXPECT_EQ(both.space.names(), (std::vector<std::string>{"prior", "m", "l"}));
  EXPECT_EQ(both.space[0].kind, Parameter::Kind::discrete);
  EXPECT_EQ(both.space[0].choices, (std::vector<double>{0, 1}));
  EXPECT_EQ(both.space.values(), (Vector{{0, 1, 2}})) << "the first prior's values are where the search starts";
  EXPECT_EQ(change_of(both, Vector{{0, 5, 6}}), 56);
  EXPECT_EQ(change_of(both, Vector{{1, 5, 6}}), 65) << "each prior keeps its own order";
}

TEST(Choice, KeepsAParameterCalledPriorApartFromItsOwn) {
  const Prior a = prior("a", {tunable("prior", 1), tunable("l", 2)}), b = prior("b", {tunable("prior", 3)});
  const Prior both = choice({a, b});
  EXPECT_EQ(both.space.names(), (std::vector<std::string>{"prior", "prior@a", "l", "prior@b"}));
  EXPECT_EQ(change_of(both, Vector{{0, 5, 6, 7}}), 56);
  EXPECT_EQ(change_of(both, Vector{{1, 5, 6, 7}}), 7);
}

TEST(Choice, MayBeAmongChoices) {
  const Prior z = prior("z", {tunable("m", 1)}), l = prior("l", {tunable("m", 2)}), r = prior("r", {tunable("m", 3)});
  const Prior all = choice({z, choice({l, r})});
  EXPECT_EQ(all.space[0].name, "prior");
  EXPECT_EQ(std::ranges::count(all.space.names(), "prior@l,r"), 1);
}

TEST(Choice, KeepsParametersOfOtherBoxesApart) {
  const Prior a = prior("a", {tunable("m", 1, {0, 5})}), b = prior("b", {tunable("m", 2, {1, 9})});
  const Prior both = choice({a, b});
  EXPECT_EQ(both.space.names(), (std::vector<std::string>{"prior", "m@a", "m@b"}));
  EXPECT_EQ(change_of(both, Vector{{0, 3, 7}}), 3);
  EXPECT_EQ(change_of(both, Vector{{1, 3, 7}}), 7);
}

TEST(Choice, FixedParametersStayEachPriorsOwn) {
  const Prior a = prior("a", {Parameter::fixed("g", 8), tunable("m", 1)}),
              b = prior("b", {Parameter::fixed("g", 9), tunable("m", 2)});
  const Prior both = choice({a, b});
  EXPECT_EQ(both.space.names(), (std::vector<std::string>{"prior", "m"}));
  EXPECT_EQ(change_of(both, Vector{{0, 5}}), 85);
  EXPECT_EQ(change_of(both, Vector{{1, 5}}), 95);
}

TEST(Choice, TunableInOneAndFixedInTheOther) {
  const Prior a = prior("a", {tunable("m", 1)}), b = prior("b", {Parameter::fixed("m", 7)});
  const Prior both = choice({a, b});
  EXPECT_EQ(both.space.names(), (std::vector<std::string>{"prior", "m"}));
  EXPECT_EQ(change_of(both, Vector{{0, 5}}), 5);
  EXPECT_EQ(change_of(both, Vector{{1, 5}}), 7);
}

TEST(Choice, AmongThreeOfTheSameSpaceIsOneMoreParameter) {
  const Prior a = prior("a", {tunable("m", 1)}), b = prior("b", {tunable("m", 2)}), c = prior("c", {tunable("m", 3)});
  EXPECT_EQ(choice({a, b, c}).space.names(), (std::vector<std::string>{"prior", "m"}));
  EXPECT_EQ(choice({a, b, c}).space[0].choices, (std::vector<double>{0, 1, 2}));
}

TEST(Choice, IsBehindServosWhereOneOfThemIs) {
  const Prior a = prior("a", {tunable("m", 1)});
  Prior b = prior("b", {tunable("m", 2)});
  EXPECT_EQ(choice({a, b}).driven, nullptr);
  b.driven = system::make_simulator(
      b.space, [](const auto&, const auto&, const Vector& phi, MatrixView dX) { dX.setConstant(100 + phi(0)); });
  const Prior behind = choice({a, b}).behind_servos();
  EXPECT_EQ(change_of(choice({a, b}), Vector{{1, 5}}), 5);
  EXPECT_EQ(change_of(behind, Vector{{0, 5}}), 5);
  EXPECT_EQ(change_of(behind, Vector{{1, 5}}), 105);
}

TEST(Choice, NeedsTwo) {
  EXPECT_THROW(choice({}), InvalidInput);
  EXPECT_THROW(choice({prior("a", {tunable("m", 1)})}), InvalidInput);
}

}  // namespace
}  // namespace rehearse::prior
