#include "rehearse/check/try_prior.hpp"

#include <gtest/gtest.h>

#include "rehearse/check/try_out.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/robot_file/test/example.hpp"
#include "rehearse/system/simulated_plant.hpp"

namespace rehearse::check {
namespace {

using robot_file::example::kSwing, robot_file::example::with;

scenario::Scenario robot(const std::string& text) {
  return robot_file::builder(text, "swing.toml", robot_file::example::no_files)->build();
}

/// The findings on a robot's prior, on three episodes of it.
PriorTried found_of(const std::string& text) { return try_out(robot(text)).priors.at(0); }

TEST(TryPrior, NamesAParameterThatChangesNothing) {
  const std::string unused = with("m = 1, l", "m = 1, k = 3, l");
  const PriorTried found = found_of(unused + "tune.k = [1, 5]\n");
  EXPECT_EQ(found.idle, std::vector<std::string>{"k"});
}

// 9.81 · 0.3 k / (0.3 k) has other last bits for another k.
TEST(TryPrior, AParameterThatCancelsChangesNothing) {
  std::string text = with("m = 1, l", "m = 1, k = 3, l");
  const std::string gravity = "9.81";
  text.replace(text.find(gravity), gravity.size(), "(9.81 * 0.3 * k / (k * 0.3))");
  EXPECT_EQ(found_of(text + "tune.k = [1, 5]\n").idle, std::vector<std::string>{"k"});
}

TEST(TryPrior, AParameterThatActsFarFromTheStartIsFound) {
  const std::string contact = with("define.torque = \"u +", "define.torque = \"u - where(abs(rate) > 40, k, 0) +");
  std::string text = contact;
  const std::string values = "m = 1, l";
  text.replace(text.find(values), values.size(), "m = 1, k = 3, l");
  const PriorTried found = found_of(text + "tune.k = [1, 5]\n");
  EXPECT_EQ(found.idle, std::vector<std::string>{});
  EXPECT_EQ(found.states, 120) << "60 steps, and as many states further off";
}

/// The swing with a prior of its own.
PriorTried with_prior(system::Change change) {
  scenario::Scenario scenario = robot(kSwing);
  scenario.priors[0].simulator = system::make_simulator(scenario.priors[0].parameters, std::move(change));
  return try_out(scenario).priors.at(0);
}

TEST(TryPrior, APriorMustRepeatItself) {
  Rng noise({.seed = 1});
  const PriorTried found = with_prior([&](const auto& X, const auto&, const auto&, MatrixView dX) {
    dX = X;
    dX(0, 1) += noise.uniform();
  });
  const std::string start =
      "predicts something else from the same states and actions a second time (1 of 60 rows, angle by ";
  EXPECT_EQ(found.broken.find(start), 0u) << found.broken;
  EXPECT_EQ(found_of(kSwing).broken, "");
}

TEST(TryPrior, RoundingThatDiffersIsSaidButNoFault) {
  Rng noise({.seed = 1});
  const PriorTried found = with_prior([&](const auto& X, const auto&, const auto&, MatrixView dX) {
    dX = X;
    dX(0, 1) += 1e-13 * noise.uniform();
  });
  EXPECT_EQ(found.broken, "");
  ASSERT_FALSE(found.notes.empty());
  EXPECT_NE(found.notes[0].find("asked for again (1 of 60 rows, angle by "), std::string::npos);
  EXPECT_EQ(found_of(kSwing).notes, std::vector<std::string>{});
}

TEST(TryPrior, APriorThatGivesTheNextStateIsAskedAboutIt) {
  scenario::Scenario scenario = robot(kSwing);
  const auto right = scenario.priors[0].simulator;
  const auto next = [right](const auto& X, const auto& U, const auto& phi, MatrixView dX) {
    right->change(X, U, phi, dX);
    dX += X;
  };
  scenario.priors[0].simulator = system::make_simulator(scenario.priors[0].parameters, next);
  const PriorTried found = try_out(scenario).priors.at(0);
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_NE(found.notes[0].find("it must give changes"), std::string::npos);
}

TEST(TryPrior, APriorsRowsMustNotKnowTheirPlace) {
  const auto with_place = [](double weight) {
    return with_prior([=](const auto& X, const auto&, const auto&, MatrixView dX) {
             dX = X;
             for (Index i = 0; i < X.rows(); ++i) dX(i, 0) += weight * static_cast<double>(i);
           })
        .broken;
  };
  const std::string start = "predicts something else of the same rows in another batch (30 of 30 rows, rate by ";
  EXPECT_EQ(with_place(0.1).find(start), 0u) << with_place(0.1);
  EXPECT_EQ(with_place(1e-16), "") << "NumPy's last bits depend on the place, too";
}

TEST(TryPrior, APriorsRowsMustNotKnowTheOthers) {
  const PriorTried found = with_prior([](const auto& X, const auto&, const auto&, MatrixView dX) {
    dX = X.rowwise() - X.colwise().mean();  // the same in any order
  });
  EXPECT_NE(found.broken.find("in another batch"), std::string::npos) << found.broken;
}

TEST(TryPrior, ErrorsAreOfTheRowsThatSucceed) {
  const auto error_where = [](Index every) {
    const PriorTried found = with_prior([=](const auto& X, const auto&, const auto&, MatrixView dX) {
      dX.setConstant(1e6);
      for (Index i = 0; i < X.rows(); ++i)
        if (i % 4 < every) dX.row(i).setConstant(kNaN);
    });
    EXPECT_EQ(found.failed, 15 * every);
    return found.error;
  };
  EXPECT_NEAR(error_where(3)(0), 1e6, 100) << "a quarter of the rows";
  EXPECT_TRUE(error_where(4).array().isNaN().all());
}

}  // namespace
}  // namespace rehearse::check
