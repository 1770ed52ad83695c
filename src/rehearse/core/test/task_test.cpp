#include "rehearse/core/task.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace rehearse {
namespace {

Task task() {
  Task task;
  task.states = {{"v", "m/s"}, {"theta", "rad", StateKind::angle}};
  task.actions = {{"u", "N", {-1, 1}}};
  task.start_mean = Vector{{0, 1}};
  task.start_std = Vector{{0, 0.1}};
  task.dt_s = 0.1;
  task.horizon = 25;
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView&, VectorView) {};
  return task;
}

TEST(Task, KnowsItsSizes) {
  EXPECT_TRUE(task().violations().empty());
  EXPECT_EQ(task().state_size(), 2);
  EXPECT_EQ(task().action_size(), 1);
  EXPECT_DOUBLE_EQ(task().episode_s(), 2.5);
  EXPECT_EQ(task().feature_map().features(), 3);
  EXPECT_EQ(task().state_names(), (std::vector<std::string>{"v", "theta"}));
}

/// The violations of a task that `spoil` changed.
template <class F>
std::vector<std::string> after(F&& spoil) {
  Task spoilt = task();
  spoil(spoilt);
  return spoilt.violations();
}

TEST(Task, LimitsHaveNamesOfTheirOwnConditionsAndRisks) {
  using Lines = std::vector<std::string>;
  const Limit good{"speed", "v < 1", [](const Steps&, VectorView kept) { kept.setOnes(); }, 0.1};
  EXPECT_EQ(after([&](Task& t) { t.limits = {good}; }), Lines{});
  EXPECT_EQ(after([&](Task& t) { t.limits = {good, good}; }), Lines(2, "there are two limits speed"));
  EXPECT_EQ(after([](Task& t) { t.limits = {{.name = "speed", .risk = 0}}; }),
            (Lines{"limit speed has no condition", "limit speed: risk = 0, must be above 0 and below 1"}));
  EXPECT_EQ(after([&](Task& t) {
              t.limits = {good};
              t.limits[0].name = "";
            }),
            Lines{"limit 1 has no name"});
}

TEST(Task, EachViolationIsNamed) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(after([](Task& t) { t.horizon = 0; }), Lines{"horizon = 0, must be ≥ 1"});
  EXPECT_EQ(after([](Task& t) { t.dt_s = -1; }), Lines{"dt_s = -1, must be > 0"});
  EXPECT_EQ(after([](Task& t) { t.reward = {}; }), Lines{"task has no reward"});
  EXPECT_EQ(after([](Task& t) { t.reward_floor = -kInf; }), Lines{"reward_floor = -inf, must be finite"});
  EXPECT_EQ(after([](Task& t) {
              t.actions[0].bounds = {1, 1};
            }),
            Lines{"action u: bounds must be finite with low < high"});
  EXPECT_EQ(after([](Task& t) { t.states[0].rate = t.states[1].name, t.states[1].rate = t.states[0].name; }),
            (Lines{"state " + task().states[0].name + ": its rates go in a circle",
                   "state " + task().states[1].name + ": its rates go in a circle"}));
  EXPECT_EQ(after([](Task& t) {
              t.states[0] = {"phi", "rad", StateKind::angle, "", "theta"};
              t.states[1].parent = "phi";
            }),
            (Lines{"state phi: its parents go in a circle", "state theta: its parents go in a circle"}));
  EXPECT_EQ(after([](Task& t) { t.states[0].rate = "speed"; }),
            Lines{"state " + task().states[0].name + ": its rate speed is not another state"});
  EXPECT_EQ(after([](Task& t) { t.actions[0].target_of = "nobody"; }),
            Lines{"action u: nobody must be a state that is no angle, to have it as a target"});
  const auto twice = [](const std::string& name) {
    return Lines{name +
                 ": two columns of a trajectory would have this name, which are time, reward, the states, \"true\" "
                 "and a state, and the actions: choose another"};
  };
  EXPECT_EQ(after([](Task& t) { t.actions[0].name = t.states[0].name; }), twice("v"));
  EXPECT_EQ(after([](Task& t) { t.actions[0].name = "true theta"; }), twice("true theta"));
  EXPECT_EQ(after([](Task& t) { t.states[0].name = "reward"; }), twice("reward"));
  const std::string first = task().states[0].name, second = task().states[1].name;
  EXPECT_EQ(after([&](Task& t) { t.states[0].parent = second; }),
            Lines{"state " + first + ": " + second + " cannot carry it, both must be angles"});
  EXPECT_EQ(after([&](Task& t) { t.states[0].parent = "nobody"; }),
            Lines{"state " + first + ": nobody cannot carry it, both must be angles"});
  EXPECT_EQ(after([](Task& t) { t.start_mean = Vector{{1}}; }),
            Lines{"start_mean has 1 entries, must have 2 finite ones"});
  EXPECT_EQ(after([](Task& t) { t.start_std(0) = -1; }), Lines{"start_std has 2 entries, must have 2 of them, ≥ 0"});
}

TEST(Task, KnowsWhichStatesAreRates) {
  Task moving = task();
  EXPECT_TRUE(moving.kinematics().pairs.empty());
  moving.states[1].rate = moving.states[0].name;
  const Kinematics kinematics = moving.kinematics();
  ASSERT_EQ(kinematics.pairs.size(), 1u);
  EXPECT_EQ(kinematics.pairs[0].position, 1);
  EXPECT_EQ(kinematics.pairs[0].rate, 0);
  EXPECT_EQ(kinematics.dt_s, moving.dt_s);
}

TEST(Task, PositionsStandBeforeRatesThatArePositions) {
  Task moving = task();
  moving.states = {{.name = "v", .rate = "a"}, {.name = "a"}, {.name = "x", .rate = "v"}};
  const auto pairs = moving.kinematics().pairs;
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].position, 2);
  EXPECT_EQ(pairs[1].position, 0);
}

TEST(Task, KnowsWhichActionsAreTargetsOfServos) {
  Task arm = task();
  EXPECT_TRUE(arm.kinematics().servos.empty());
  arm.states = {{"q1", "rad", StateKind::plain, "v1"}, {"v1", "rad/s"}, {"q2", "rad"}};
  arm.actions = {{"force", "N", {-1, 1}},
                 {"target 1", "rad", {-1, 1}, "q1", "small"},
                 {"target 2", "rad", {-1, 1}, "q2"},
                 {"target 3", "rad", {-1, 1}, "q2", "small"}};
  const auto servos = arm.kinematics().servos;
  ASSERT_EQ(servos.size(), 3u);
  const auto is = [&](std::size_t i, Index action, Index position, Index rate, Index type) {
    return servos[i].action == action && servos[i].position == position && servos[i].rate == rate &&
           servos[i].type == type;
  };
  EXPECT_TRUE(is(0, 1, 0, 1, 1));
  EXPECT_TRUE(is(1, 2, 2, -1, 2)) << "like no other";
  EXPECT_TRUE(is(2, 3, 2, -1, 1)) << "of the type of the first";
}

TEST(Task, ModelsSeeTheAnglesOfJoints) {
  Task chain = task();
  EXPECT_TRUE(chain.model_features().joints().empty());
  chain.states = {{"a", "rad", StateKind::angle}, {"b", "rad", StateKind::angle}};
  chain.states[1].parent = "a";
  const FeatureMap features = chain.model_features();
  ASSERT_EQ(features.joints().size(), 1u);
  EXPECT_EQ(features.joints()[0].angle, 1);
  EXPECT_EQ(features.joints()[0].parent, 0);
  EXPECT_EQ(chain.feature_map().features(), 4) << "policies do not";
}

TEST(Task, DescriptorsHaveFiniteBounds) {
  Task described = task();
  described.descriptor_bounds = {{0, 1}, {1, 1}, {-1e308, 1e308}};
  EXPECT_EQ(described.violations(), (std::vector<std::string>{"descriptor_bounds 2: must be finite with low < high",
                                                              "descriptor_bounds 3: must be finite with low < high"}));
}

TEST(Task, DescriptorsHaveANameEachOrNone) {
  Task described = task();
  described.descriptor_bounds = {{0, 1}, {0, 1}};
  EXPECT_EQ(described.descriptor_labels(), (std::vector<std::string>{"descriptor 1", "descriptor 2"}));
  described.descriptor_names = {"reach [m]", "height [m]"};
  EXPECT_EQ(described.descriptor_labels(), described.descriptor_names);
  EXPECT_EQ(described.violations(), std::vector<std::string>{});
  described.descriptor_names.pop_back();
  EXPECT_EQ(described.violations(),
            std::vector<std::string>{"descriptor_names has 1 entries, must have 2, as descriptor_bounds, or none"});
}

TEST(Task, ConditionsOfStatesGoByRow) {
  const StateCondition high = each_state([](const ConstVectorView& x) { return x(1) > 2; });
  Vector values(3);
  high(Matrix{{0, 1}, {0, 3}, {0, kNaN}}, values);
  EXPECT_EQ(values, (Vector{{0, 1, 0}}));
  EXPECT_TRUE(holds(high, Vector{{0, 3}}));
  EXPECT_FALSE(holds(high, Vector{{3, 0}}));
  EXPECT_FALSE(is_true(kNaN));
  EXPECT_TRUE(is_true(-0.5));
}

TEST(Task, AnEmptyOneLacksEverything) {
  EXPECT_EQ(Task().violations().size(), 5u) << "states, actions, dt_s, horizon, reward";
}

// A start that is missing or too long must not become numbers from nowhere.
TEST(Task, OfAWrongStartIsWrongWithMemoryToo) {
  Task task;
  task.states = {{"x", "m"}, {"v", "m/s"}};
  task.actions = {{"u", "N", {-1, 1}}};
  task.actions.front().actuation.delay_s = 0.2;
  task.dt_s = 0.1;
  task.horizon = 3;
  task.reward = [](const ConstMatrixView&, const ConstMatrixView&, const ConstMatrixView&, VectorView r) {
    r.setZero();
  };
  for (const Index wrong : {0, 1, 3}) {
    task.start_mean = Vector::Zero(wrong);
    task.start_std = Vector::Zero(2);
    EXPECT_EQ(with_memory(task).violations().size(), 1U) << wrong;
  }
  task.start_mean = Vector{{1, 2}};
  const Task right = with_memory(task);
  EXPECT_TRUE(right.violations().empty());
  EXPECT_EQ(right.start_mean.head(2), (Vector{{1, 2}}));
  EXPECT_EQ(right.start_std, Vector::Zero(right.state_size()));
}

TEST(Task, DifferencesOfAnglesAreTheShorterWayRound) {
  const Vector difference = task().difference(Vector{{7, 3}}, Vector{{0, -3}});
  EXPECT_EQ(difference(0), 7);
  EXPECT_NEAR(difference(1), 6 - 2 * std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace rehearse
