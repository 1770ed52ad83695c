#include "rehearse/learners/model_of_trials.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rehearse/policy/schedule.hpp"
#include "slider.hpp"

namespace rehearse::learners {
namespace {

Setting slider_setting() {
  Setting setting;
  setting.task = slider::task();
  setting.prior = slider::prior();
  setting.evaluator = make_thread_evaluator(1);
  return setting;
}

/// An episode of the slider under pulls that change.
Episode an_episode(std::uint64_t trial) {
  const Task task = slider::task();
  const auto random = policy::make_schedule(task);
  const Vector theta = policy::random_schedule(task, policy::RandomActions::uniform, 0, {.trial = trial});
  Proposal proposal{.policy = random, .theta = theta};
  return slider::run_trial(proposal, trial);
}

TEST(ModelOfTrials, TrustsThePriorUntilItIsTold) {
  const Setting setting = slider_setting();
  ModelOfTrials model(setting, identification::GpMi{}, 0.25);
  EXPECT_TRUE(model.without_data());
  Proposal proposal;
  model.learn(proposal);
  Matrix mean(1, 1), variance(1, 1);
  proposal.model->predict(Matrix{{0.3}}, Matrix{{0.5}}, mean, variance);
  EXPECT_EQ(variance(0, 0), 0.25);
  EXPECT_EQ(*proposal.phi, setting.prior->space.values());
}

TEST(ModelOfTrials, LearnsFromLogsAndTrials) {
  const Setting setting = slider_setting();
  ModelOfTrials model(setting, identification::GpMi{});
  model.study({an_episode(1)});
  EXPECT_FALSE(model.without_data());
  model.add(an_episode(2));
  EXPECT_EQ(model.data().size(), 24);
  Proposal proposal;
  model.keep(model.learn(proposal));
  EXPECT_TRUE(proposal.phi->isApprox(slider::kTruth, 0.02)) << *proposal.phi;
}

TEST(ModelOfTrials, GoesOnFromWhatItSaved) {
  const Setting setting = slider_setting();
  ModelOfTrials model(setting, identification::GpMi{}), restored(setting, identification::GpMi{});
  model.add(an_episode(1));
  Proposal proposal;
  model.keep(model.learn(proposal));
  model.add(an_episode(2));
  nlohmann::json state, again;
  model.save(state);
  restored.restore({an_episode(1), an_episode(2)}, state);
  restored.save(again);
  EXPECT_EQ(state, again);
  Proposal next, next_restored;
  model.learn(next);
  restored.learn(next_restored);
  EXPECT_EQ(*next.phi, *next_restored.phi);
  EXPECT_EQ(*next.log_evidence, *next_restored.log_evidence);
}

TEST(ModelOfTrials, TrustsThePriorWhereNothingCanBeLearned) {
  const Setting setting = slider_setting();
  ModelOfTrials model(setting, identification::GpMi{}, 0.25);
  Episode empty;
  empty.states = empty.true_states = Matrix{{1}};
  empty.actions = Matrix(0, 1);
  empty.rewards = Vector(0);
  model.add(empty);
  Proposal proposal;
  model.learn(proposal);
  EXPECT_TRUE(proposal.model->certain());
  EXPECT_EQ(proposal.notes.size(), 1U);
}

// Rows are left out where the prior fails, and only there.
TEST(ModelOfTrials, SaysThatRowsAreLeftOutWhereThePriorIsNotFinite) {
  const auto learned = [](const Setting& setting, identification::GpMi kind) {
    ModelOfTrials model(setting, std::move(kind));
    model.add(an_episode(1));
    Proposal proposal;
    model.learn(proposal);
    EXPECT_EQ(proposal.notes.size(), 1U);
    return proposal.left_out_rows;
  };
  Setting broken = slider_setting();
  broken.prior->simulator = system::make_ode_simulator(
      [](const Vector&, const Vector&, const Vector&, Vector& dxdt) { dxdt.setConstant(kNaN); }, broken.prior->space,
      broken.task.dt_s, 1);
  EXPECT_EQ(learned(broken, {}), 12);
  identification::GpMi impossible;
  impossible.gp.fit.method = gp::FitMethod::rprop;
  impossible.gp.fit.rprop.first_step = 100;
  EXPECT_EQ(learned(slider_setting(), impossible), 0);
}

}  // namespace
}  // namespace rehearse::learners
