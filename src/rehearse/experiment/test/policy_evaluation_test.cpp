#include "rehearse/experiment/policy_evaluation.hpp"

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::experiment {
namespace {

using fake::line_spec, fake::message_of;

/// The line, and u = −x, which is near zero after 5 s, not after 1.2 s.
Resolved line_where(const std::vector<std::pair<std::string, std::string>>& options = {}) {
  Spec spec = line_spec(1);
  spec.options = options;
  return resolve(fake::catalogue(), spec);
}

Learned slow_policy() { return {std::make_shared<fake::LinePolicy>(), Vector{{-1, 0}}, 2}; }

std::string table_of(const std::vector<Outcome>& outcomes) {
  return evaluation_csv(outcomes, {2, "noise=0.1", 9, 2.4});
}

TEST(PolicyEvaluation, LooksAtTheEndOfLongerEpisodes) {
  const EvaluationPlan plan{.episodes = 20, .seconds = 5, .seed = 3};
  const auto outcomes = evaluate(line_where(), slow_policy(), plan, serial_evaluator());
  ASSERT_EQ(outcomes.size(), 20u);
  for (const Outcome& each : outcomes) {
    EXPECT_FALSE(*each.solved);
    EXPECT_TRUE(*each.solved_at_end);
    EXPECT_FALSE(each.ended_s);
    EXPECT_GT(each.total_reward, 40);
  }
  const auto short_ones = evaluate(line_where(), slow_policy(), {.episodes = 20, .seed = 3}, serial_evaluator());
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(short_ones[i].solved, outcomes[i].solved);
    EXPECT_EQ(short_ones[i].solved_at_end, outcomes[i].solved) << "the task's own end";
  }
}

TEST(PolicyEvaluation, IsTheSameOnAnyNumberOfThreads) {
  const EvaluationPlan plan{.episodes = 37, .seconds = 2, .seed = 5};
  const Resolved noisy = line_where({{"noise", "0.1"}});
  const std::string one = table_of(evaluate(noisy, slow_policy(), plan, serial_evaluator()));
  EXPECT_EQ(table_of(evaluate(noisy, slow_policy(), plan, *make_thread_evaluator(3))), one);
  EvaluationPlan other = plan;
  other.seed = 6;
  EXPECT_NE(table_of(evaluate(noisy, slow_policy(), other, serial_evaluator())), one);
}

TEST(PolicyEvaluation, AMoreOfEpisodesBeginsWithTheSame) {
  const auto few = evaluate(line_where(), slow_policy(), {.episodes = 13}, serial_evaluator());
  const auto many = evaluate(line_where(), slow_policy(), {.episodes = 40}, serial_evaluator());
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i].total_reward, many[i].total_reward);
}

TEST(PolicyEvaluation, CountsFalls) {
  Resolved falls = line_where();
  falls.scenario.task.ended = each_state([](const ConstVectorView& x) { return x(0) < 0.5; });
  falls.scenario.task.solved = [](const Episode& episode) { return !episode.ended; };
  falls.scenario.task.reward_floor = -1;
  const EvaluationPlan plan{.episodes = 12, .seconds = 5};
  const auto outcomes = evaluate(falls, slow_policy(), plan, serial_evaluator());
  const Summary summary = summary_of(outcomes);
  EXPECT_EQ(summary.ended.count, 12);
  EXPECT_EQ(summary.solved_at_end->count, 0);
  EXPECT_LT(*outcomes[0].ended_s, 2);
  EXPECT_LT(summary.returns[0], -20) << "the floor is charged for what is left";
}

TEST(PolicyEvaluation, NamesTheLimitsThatAreBroken) {
  Resolved limited = line_where();
  const StepCondition never = [](const Steps&, VectorView holds) { holds.setZero(); };
  const StepCondition always = [](const Steps&, VectorView holds) { holds.setOnes(); };
  limited.scenario.task.limits = {{"hopeless", "", never}, {"easy", "", always}};
  const auto outcomes = evaluate(limited, slow_policy(), {.episodes = 3}, serial_evaluator());
  EXPECT_EQ(outcomes[0].broke, std::vector<std::string>{"hopeless"});
  const Summary summary = summary_of(outcomes);
  EXPECT_EQ(summary.ended.count, 3);
  ASSERT_EQ(summary.broke.size(), 1u);
  EXPECT_EQ(summary.broke.at("hopeless").count, 3);
}

TEST(PolicyEvaluation, ATaskMayNotSayWhatIsSolved) {
  Resolved silent = line_where();
  silent.scenario.task.solved = {};
  const auto outcomes = evaluate(silent, slow_policy(), {.episodes = 2}, serial_evaluator());
  EXPECT_FALSE(summary_of(outcomes).solved);
  EXPECT_NE(table_of(outcomes).find(",,,,\n"), std::string::npos);
}

TEST(PolicyEvaluation, IsATableOfItsEpisodes) {
  const std::vector<Outcome> outcomes = {{1.5, true, false, {}, {}}, {-2, false, false, 0.7, {"speed", "track"}}};
  EXPECT_EQ(table_of(outcomes),
            "trial,settings,seed,seconds,episode,return,solved,solved_at_end,ended_s,broke\n"
            "2,noise=0.1,9,2.4,1,1.5,1,0,,\n2,noise=0.1,9,2.4,2,-2,0,0,0.7,speed; track\n");
}

TEST(PolicyEvaluation, RatesHaveExactIntervals) {
  std::vector<Outcome> outcomes(100, {.total_reward = 1, .solved = true, .solved_at_end = false});
  outcomes[7].solved = false;
  const Summary summary = summary_of(outcomes);
  EXPECT_EQ(summary.solved->count, 99);
  EXPECT_NEAR(summary.solved->interval.low, 0.9455, 1e-4);  // Clopper and Pearson
  EXPECT_NEAR(summary.solved_at_end->interval.high, 0.0362, 1e-4);
  EXPECT_EQ(summary.ended.count, 0);
}

TEST(PolicyEvaluation, ThePriorPlaysARobotThatHasNoPlant) {
  Resolved told = line_where();
  ASSERT_TRUE(told.prior);
  told.scenario.make_plant = nullptr;
  const auto on_prior = evaluate(told, slow_policy(), {.episodes = 2}, serial_evaluator());
  told.prior->space = told.prior->space.fixed_at(told.prior->space.values() * 1.5);
  EXPECT_NE(evaluate(told, slow_policy(), {.episodes = 2}, serial_evaluator())[0].total_reward,
            on_prior[0].total_reward)
      << "its parameters are the robot's";
  told.scenario.stand_in_noise = Vector::Constant(told.scenario.task.state_size(), 0.1);
  const auto noisy = evaluate(told, slow_policy(), {.episodes = 2}, serial_evaluator());
  told.scenario.stand_in_noise *= 2;
  EXPECT_NE(evaluate(told, slow_policy(), {.episodes = 2}, serial_evaluator())[0].total_reward, noisy[0].total_reward);
  told.spec.prior = "near,far";
  EXPECT_FALSE(has_robot(told)) << "a choice among several is no robot";
  told.prior.reset();
  EXPECT_NE(message_of<InvalidInput>([&] {
              evaluate(told, slow_policy(), {.episodes = 2}, serial_evaluator());
            }).find("no plant that episodes could run on"),
            std::string::npos);
}

TEST(PolicyEvaluation, AStepThatThePriorCannotSimulateIsAFall) {
  Resolved told = line_where();
  told.scenario.make_plant = nullptr;
  const auto before = told.prior->simulator;
  told.prior->simulator = system::make_simulator(
      told.prior->space,
      [before](const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) {
        before->change(X, U, phi, dX);
        for (Index i = 0; i < X.rows(); ++i)
          if (X(i, 0) < 0.5) dX.row(i).setConstant(kNaN);
      });
  const auto outcomes = evaluate(told, slow_policy(), {.episodes = 3, .seconds = 5}, serial_evaluator());
  for (const Outcome& each : outcomes) {
    ASSERT_TRUE(each.ended_s);
    EXPECT_GT(*each.ended_s, 0);
  }
}

TEST(PolicyEvaluation, SaysWhatIsWrong) {
  const auto said = [](const EvaluationPlan& plan) {
    return message_of<InvalidInput>([&] { evaluate(line_where(), slow_policy(), plan, serial_evaluator()); });
  };
  EXPECT_NE(said({.seconds = 0.5}).find("seconds = 0.5, must be between 1.2"), std::string::npos)
      << said({.seconds = 0.5});
  EXPECT_EQ(said({.episodes = 0}), "episodes = 0, must be between 1 and 1000000");
  EXPECT_EQ(said({.episodes = 1000000000000, .seed = -1}),
            "episodes = 1000000000000, must be between 1 and 1000000\n"
            "seed = -1, must be between 0 and 9007199254740992");
  Learned wrong = slow_policy();
  wrong.theta = Vector::Zero(3);
  EXPECT_THROW(evaluate(line_where(), wrong, EvaluationPlan{}, serial_evaluator()), InvalidInput);
}

}  // namespace
}  // namespace rehearse::experiment
