#include "rehearse/mujoco/states.hpp"

#include <gtest/gtest.h>

#include "rehearse/mujoco/test/robots.hpp"

namespace rehearse::mujoco {
namespace {

/// The complaints about these states of the acrobot.
std::string states_complaint(std::vector<State> states, const char* file = "acrobot.xml") {
  return complaint_of([&] {
    ModelDescription model = acrobot_model(file);
    model.states = std::move(states);
    if (std::string(file) != "acrobot.xml") model.actions.clear();
    compile(model);
  });
}

TEST(States, AnglesMayHaveAnotherZeroSignAndParent) {
  const ModelPointer model = load(data_file("acrobot.xml"));
  const DataPointer data = make_data(*model);
  Violations violations;
  const States states(*model,
                      {{"a1", State::Kind::position, {{"shoulder", -1}}, M_PI},
                       {"a2", State::Kind::position, {{"shoulder"}, {"elbow", 2}}, 0.5}},
                      violations);
  ASSERT_TRUE(violations.empty());
  const Vector x{{1, 2}};
  states.write(x, *data);
  EXPECT_DOUBLE_EQ(data->qpos[0], M_PI - 1);
  EXPECT_DOUBLE_EQ(data->qpos[1], (1.5 - (M_PI - 1)) / 2);
  Vector back(2);
  states.read(*data, back);
  EXPECT_NEAR((back - x).norm(), 0, 1e-15);
}

TEST(States, WhatIsReadOnlyFollowsFromTheJoints) {
  const ModelPointer model = load(data_file("pendulum.xml"));
  const DataPointer data = make_data(*model);
  Violations violations;
  const States states(*model,
                      {{"angle", State::Kind::position, {{"hinge"}}, 0},
                       {"rate", State::Kind::velocity, {{"hinge"}}, 0},
                       {"tip x", State::Kind::site, {{"tip", 1, 0}}, 0},
                       {"height", State::Kind::sensor, {{"tip place", 1, 2}}, 1},
                       {"speed", State::Kind::sensor, {{"speed", -1}}, 0},
                       {"arm", State::Kind::body, {{"arm", 1, 2}}, 0}},
                      violations);
  ASSERT_TRUE(violations.empty());
  Vector x{{0.3, 2, 7, 7, 7, 7}};
  states.write(x, *data);
  states.prepare(*model, *data);
  states.read(*data, x);
  const Vector expected{{0.3, 2, std::sin(0.3), 1 - std::cos(0.3), -2, 0}};
  EXPECT_NEAR((x - expected).norm(), 0, 1e-14);
}

TEST(States, WrongStatesAreAllNamed) {
  const std::string complaint = states_complaint({{"a", State::Kind::position, {{"sholder"}}, 0},
                                                  {"b", State::Kind::velocity, {{"elbow"}, {"elbow"}}, 0},
                                                  {"c", State::Kind::body, {{"upper", 1, 3}}, 0},
                                                  {"d", State::Kind::position, {{"elbow", 0}}, 0},
                                                  {"e", State::Kind::site, {}, 0}});
  EXPECT_EQ(complaint,
            "state 'a': there is no joint 'sholder', did you mean 'shoulder'? (known: shoulder, elbow)\n"
            "state 'b' names the joint 'elbow' twice\n"
            "state 'c': component = 3 of 'upper', must be from 0 to 2\n"
            "state 'd': factor = 0 of 'elbow', must be finite and not 0\n"
            "state 'e' has no terms, must have one");
}

TEST(States, PositionsMustTellTheJointsApart) {
  EXPECT_EQ(
      states_complaint({{"a", State::Kind::position, {{"elbow"}}, 0}, {"b", State::Kind::position, {{"elbow", 2}}, 0}}),
      "the 2 positions (a, b) of 1 joints (elbow): there must be one of each joint");
  EXPECT_EQ(states_complaint({{"a", State::Kind::velocity, {{"elbow"}, {"shoulder"}}, 0},
                              {"b", State::Kind::velocity, {{"elbow", 2}, {"shoulder", 2}}, 0}}),
            "the 2 velocities (a, b) of 2 joints (elbow, shoulder) do not tell these apart: one follows from others");
}

TEST(States, FreeJointsAreNoStates) {
  EXPECT_EQ(states_complaint({{"x", State::Kind::position, {{"sea"}}, 0}}, "loose.xml"),
            "state 'x': 'sea' is a free joint, must be a hinge or a slide: put three slides and three hinges "
            "(in a plane two and one) in its place in the model, or read the body by { sensor = … } or { body = … }");
}

}  // namespace
}  // namespace rehearse::mujoco
