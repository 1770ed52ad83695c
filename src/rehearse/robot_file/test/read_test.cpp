#include "rehearse/robot_file/read.hpp"

#include <gtest/gtest.h>

#include "example.hpp"

namespace rehearse::robot_file {
namespace {

using example::complaint_of, example::kSwing, example::with;

TEST(ReadRobot, TakesEverythingThatStandsInTheFile) {
  const Robot robot = read(kSwing, "swing.toml", example::no_files);
  EXPECT_EQ(robot.name, "swing");
  EXPECT_EQ(robot.horizon, 20);
  EXPECT_EQ(robot.state_names(), (std::vector<std::string>{"rate", "angle"}));
  EXPECT_EQ(robot.states[0].scale, 10);
  EXPECT_EQ(robot.states[1].variable.kind, StateKind::angle);
  EXPECT_EQ(robot.actions[0].bounds.high, 2);
  EXPECT_EQ(robot.reward.distance.size(), 2u);
  ASSERT_EQ(robot.dynamics.size(), 1u);
  EXPECT_EQ(std::get<Equations>(robot.dynamics[0].source).rates[0].text, "torque / (m * l^2)");
  EXPECT_EQ(std::get<Equations>(robot.dynamics[0].source).rates[1].text, "rate") << "the state that is its rate";
  EXPECT_EQ(robot.plant.parameters.values(), (Vector{{1, 0.5}}));
  ASSERT_EQ(robot.priors.size(), 1u);
  EXPECT_EQ(robot.priors[0].dynamics, "pendulum") << "the first";
  EXPECT_EQ(robot.priors[0].parameters[0].value, 1.3);
  EXPECT_EQ(robot.priors[0].parameters[0].box.high, 2);
  EXPECT_EQ(robot.priors[0].parameters[1].kind, Parameter::Kind::fixed);
}

TEST(ReadRobot, PriorsKeepTheirOrder) {
  const Robot robot = read(kSwing + "[prior.a]\n[prior.b]\n", "swing.toml", example::no_files);
  ASSERT_EQ(robot.priors.size(), 3u);
  EXPECT_EQ(robot.priors[0].name, "heavy");
  EXPECT_EQ(robot.priors[2].name, "b");
}

struct Wrong {
  const char *part, *by, *said;
};
void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.by; }

class WrongRobot : public ::testing::TestWithParam<Wrong> {};

// Every message names the file, the line and what to write.
TEST_P(WrongRobot, IsRefusedWithItsLine) {
  const auto& [part, by, said] = GetParam();
  const std::string complaint = complaint_of(with(part, by));
  EXPECT_NE(complaint.find("swing.toml: "), std::string::npos) << complaint;
  EXPECT_NE(complaint.find(said), std::string::npos) << complaint;
}

const Wrong kWrong[] = {
    {"format = 1", "format = 2", "line 1: format must be 1"},
    {"format = 1", "format = true", "line 1: format must be 1"},
    {"name = \"swing\"", "name = \"my swing\"", "line 2: name = 'my swing', must be of letters"},
    {"name = \"swing\"", "nmae = \"swing\"", "line 2: unknown key 'nmae', did you mean 'name'?"},
    {"[define]", "[[limit]]\nname = \"a\"\n[define]", "line 21: a limit needs keep = \"…\""},
    {"[define]", "[[limit]]\nkeep = \"abs(x) < 1\"\n[define]", "line 22: limit.keep: unknown name 'x'"},
    {"[define]", "[[limit]]\nkeep = \"u < 1\"\nrisk = 0\n[define]", "line 23: risk = 0, must be between"},
    {"dt_s = 0.1", "dt_s = 0", "line 3: dt_s = 0, must be > 0 and ≤ 1000000"},
    {"dt_s = 0.1", "", "dt_s is missing"},
    {"dt_s = 0.1", "dt_s = 1e300", "line 3: dt_s = 1e+300, must be > 0 and ≤ 1000000"},
    {"dt_s = 0.1", "dt_s = \"fast\"", "line 3: dt_s = \"fast\", must be a number, without quotes"},
    {"horizon = 20", "horizon = 0", "line 4: horizon = 0, must be between 1 and 1000000"},
    {"horizon = 20", "horizon = 99999999999", "line 4: horizon = 99999999999, must be between"},
    {"horizon = 20", "horizon = true", "line 4: horizon = true, must be a whole number"},
    {"horizon = 20", "horizon = \"20\"", "line 4: horizon = \"20\", must be a whole number, without quotes"},
    {"horizon = 20", "", "horizon is missing: control steps of an episode"},
    {"horizon = 20", "horizon = 2.5", "horizon = 2.5, must be a whole number"},
    {"name = \"rate\"", "", "a state needs a name"},
    {"name = \"angle\"", "name = \"rate\"", "the name 'rate' is given twice"},
    {"name = \"rate\"", "name = \"sin\"", "'sin' is a function"},
    {"scale = 10", "scale = -1", "scale = -1, must be > 0"},
    {"scale = 10", "skale = 10", "unknown key 'skale' in [[state]], did you mean 'scale'?"},
    {"rate = \"rate\"", "rate = \"rat\"",
     "line 12: state angle: its rate 'rat' is not another state, did you mean 'rate'?"},
    {"angle = true", "angle = 1", "angle = 1"},
    {"start = 3", "start = \"up\"", "start = \"up\", must be a number"},
    {"start_noise = 0.1", "start_noise = -0.1", "start_noise = -0.1, must be ≥ 0"},
    {"bounds = [-2, 2]", "bounds = [2, -2]", "bounds = [2, -2], must be [low, high] with low < high"},
    {"bounds = [-2, 2]", "bounds = 2", "bounds must be [low, high]"},
    {"bounds = [-2, 2]", "", "an action needs bounds = [low, high]"},
    {"bounds = [-2, 2]", "bounds = [-inf, inf]", "line 19: bounds = [-inf, inf], must be finite"},
    {"unit = \"N m\"", "unit = \"N\\nm\"", "line 18: unit must have no brackets"},
    {"unit = \"N m\"", "unit = \"[N]\"", "line 18: unit must have no brackets"},
    {"unit = \"N m\"", "max_rate = 0", "line 18: max_rate = 0, must be > 0"},
    {"unit = \"N m\"", "filter_s = -1", "line 18: filter_s = -1, must be ≥ 0"},
    {"unit = \"N m\"", "delay_s = 11", "line 18: delay_s = 11, must be between 0 and 10"},
    {"unit = \"N m\"", "lag_s = -0.1", "line 18: lag_s = -0.1, must be ≥ 0"},
    {"unit = \"N m\"", "remember = 101", "line 18: remember = 101, must be between 0 and 100"},
    {"unit = \"N m\"", "remember = 0.5", "line 18: remember = 0.5"},
    {"unit = \"N m\"", "delay = 1", "unknown key 'delay' in [[action]], did you mean 'delay_s'?"},
    {"name = \"u\"",
     "name = \"u\"\nremember = 1\n[[action]]\nname = \"u_last\"\nbounds = [0, 1]\n[[action]]\nname = \"w\"",
     "the name 'u_last' is given twice"},
    {"[plant]", "[plant]\ndelay_s = { v = 1 }", "unknown key 'v' in [plant] delay_s, did you mean 'u'?"},
    {"[plant]", "[plant]\ndelay_s = { u = 11 }", "u = 11, must be between 0 and 10"},
    {"[plant]", "[plant]\nlag_s = { u = -1 }", "u = -1, must be ≥ 0"},
    {"[[action]]", "[action]", "each action is a part of its own: [[action]]"},
    {"height = \"cos(angle)\"", "height = \"cos(angel)\"", "height: unknown name 'angel', did you mean 'angle'?"},
    {"height = \"cos(angle)\"", "height = \"height + 1\"", "needs itself: height → height"},
    {"height = \"cos(angle)\"", "height = [1]", "height must be a formula in quotes, or a number"},
    {"distance = [", "distances = [", "unknown key 'distances' in [reward], did you mean 'distance'?"},
    {"distance = [\"1 - height\", \"sin(angle)\"]", "", "[reward] needs distance = […]"},
    {"\"sin(angle)\"]", "\"sin angle\"]", "reward.distance: 'sin' is a function: sin(…)"},
    {"\"sin(angle)\"]", "\"sin(angle\"]", "reward.distance: 'sin(angle'"},
    {"width = 0.5", "formula = \"height\"", "line 26: [reward] has distance and formula, must have one of them"},
    {"width = 0.5", "width = 0", "width = 0, must be > 0"},
    {"[reward]", "[rewards]", "unknown key 'rewards', did you mean 'reward'?"},
    {"when = \"height > 0.9\"", "", "[success] needs when"},
    {"when = \"height > 0.9\"", "when = \"height ? 1 : 0\"", "success.when: 'a ? b : c' is written where(a, b, c)"},
    {"last_s = 0.2", "last_s = -1", "last_s = -1, must be ≥ 0"},
    {"[dynamics.pendulum]", "[dynamic.pendulum]", "unknown key 'dynamic', did you mean 'dynamics'?"},
    {"m = 1, l", "m = \"heavy\", l", "m must be a number"},
    {"{ value = 0.5, unit = \"m\" }", "{ unit = \"m\" }", "parameter l needs a value"},
    {"m = 1, l = {", "u = 1, l = {", "unknown parameter 'm'"},
    {"rate.rate = \"torque / (m * l^2)\"", "rate.rat = \"torque\"",
     "rate.rat: there is no state 'rat', did you mean 'rate'?"},
    {"rate.rate = \"torque / (m * l^2)\"", "", "rate.rate is missing: the derivative of rate by time"},
    {"rate.rate = \"torque", "rate.angle = \"2 * rate\"\nrate.rate = \"torque",
     "rate.angle = \"2 * rate\", but the rate of the state angle is \"rate\""},
    {"torque / (m * l^2)", "torque / (m * L^2)", "rate.rate: unknown name 'L', did you mean 'l'?"},
    {"define.torque = \"u +", "define.torque = \"u + +* ", "torque: 'u + +* "},
    {"[plant]", "[plant]\ndynamics = \"pendulums\"", "there is no [dynamics.pendulums], did you mean 'pendulum'?"},
    {"[plant]", "[plant]\nmeasurement_noise = -1", "measurement_noise = -1, must be ≥ 0"},
    {"[plant]", "[plant]\nmeasurement_noise = [0.1, 0.1]",
     "measurement_noise must be a number, or one for each state: { NAME = 0.01 }"},
    {"[plant]", "[plant]\nmeasurement_noise.angel = 0.1",
     "unknown key 'angel' in [plant] measurement_noise, did you mean 'angle'?"},
    {"[plant]", "[plant]\nmeasurement_noise.angle = -1", "angle = -1, must be ≥ 0"},
    {"[plant]", "[plant]\nparameters.mass = 1", "unknown parameter 'mass', did you mean 'm'? (known: m, l)"},
    {"[plant]", "[plant]\ntune.m = [0, 1]", "unknown key 'tune' in [plant]"},
    {"tune.m = [0.5, 2]", "tune.m = [2, 0.5]", "tune.m = [2, 0.5], must be [low, high] with low < high"},
    {"tune.m = [0.5, 2]", "tune.m = [0.5, 1]", "line 41: m = 1.3, must be between 0.5 and 1"},
    {"tune.m = [0.5, 2]", "tune.m = 2", "tune.m must be [low, high]"},
    {"tune.m = [0.5, 2]", "tune.n = [0.5, 2]", "unknown parameter 'n', did you mean 'm'?"},
    {"[prior.heavy]", "[prior.\"../../p/q\"]", "line 39: the name of prior '../../p/q' must be of letters, digits"},
    {"[prior.heavy]", "[prior.\"a,b\"]", "the name of prior 'a,b' must be of letters"},
    {"[prior.heavy]", "[prior.\"\"]", "the name of prior '' must be of letters"},
    {"[prior.heavy]", "[prior.oracle]", "line 39: 'oracle' is the plant's own dynamics, and no name of a prior"},
    {"[plant]", "[policy]\npolicy = \"deep\"\n[plant]", "policy = deep"},
    {"[plant]", "[policy]\nhiden = 5\n[plant]", "unknown key 'hiden' in [policy], did you mean 'hidden'?"},
    {"[plant]", "[[body]]\nname = \"rod\"\nfrom = [0, 0]\n[plant]", "a body goes from = [x, y] to = [x, y]"},
    {"[plant]", "[[body]]\nname = \"rod\"\nfrom = [0, 0]\nto = [\"x\", 1]\n[plant]", "body rod: unknown name 'x'"},
    {"dt_s = 0.1", "dt_s = 0.1\nended = \"angle >\"", "ended: 'angle >'"},
    {"dt_s = 0.1", "dt_s = 0.1\nended = \"abs(u) > 1\"",
     "line 4: ended: 'u' is an action, and this is a formula of states; the last command is the state u_last"},
    {"dt_s = 0.1", "dt_s = 0.1\nended = \"time > 1\"",
     "line 4: ended: 'time' is known to the `cost` of [reward], which is subtracted from it, and to the `keep`"},
    {"when = \"height > 0.9\"", "when = \"abs(u) < 0.001\"", "line 29: success.when: 'u' is an action"},
    {"\"sin(angle)\"]", "\"u\"]", "line 25: reward.distance: 'u' is an action"},
    {"\"cos(angle)\"\n\n[reward]\ndistance = [\"1 - height\"", "\"u\"\n\n[reward]\ndistance = [\"height\"",
     "line 25: reward.distance: 'u', which the definition of 'height' uses, is an action"},
    {"[plant]", "[[body]]\nname = \"rod\"\nfrom = [0, 0]\nto = [\"u\", 1]\n[plant]", "body rod: 'u' is an action"},
    {"\"sin(angle)\"]", "\"\"]", "line 25: distance must be a formula in quotes, or a number"},
    {"rate.rate = \"torque / (m * l^2)\"", "rate.rate = \" \"",
     "line 35: rate must be a formula in quotes, or a number"},
    {"\"sin(angle)\"]", "\"1,5 - height\"]", "line 25: reward.distance: '1,5 - height': a comma outside"},
    {"when = \"height > 0.9\"", "when = \"height\"",
     "line 29: success.when: 'height' is a number and no condition: compare it, as in height < 0.5"},
    {"dt_s = 0.1", "dt_s = 0.1\nended = \"sin(angle) + 2\"", "line 4: ended: 'sin(angle) + 2' is a number"},
    {"[define]", "[[limit]]\nkeep = \"u\"\n[define]", "line 22: limit.keep: 'u' is a number"},
    {"when = \"height > 0.9\"", "when = \"0.9 < height < 1.1\"",
     "line 29: success.when: 'a < b < c' is written a < b && b < c"},
    {"tune.m = [0.5, 2]", "tune.m = { choices = [\"1.0\", 1.3] }", "line 41: a choice of tune.m must be a number"},
    {"tune.m = [0.5, 2]", "tune.m = { choices = [] }", "line 41: parameter m has no choices"},
    {"[prior.heavy]",
     "[dynamics.bare]\nrate.rate = \"u\"\n[prior.bare]\ndynamics = \"bare\"\ntune.k = [0, 1]\n[prior.heavy]",
     "line 43: 'k' is no parameter: the dynamics has none"},
    {"angle = true", "angle = true\ninput = false",
     "line 12: angle = true says how models and policies see a state, and input = false that they do not"},
    {"dt_s = 0.1", "dt_s = 0.1 0.2", "line 3: "},
};
INSTANTIATE_TEST_SUITE_P(Files, WrongRobot, ::testing::ValuesIn(kWrong));

TEST(ReadRobot, SomethingMustBeSeen) {
  std::string text = with("angle = true", "input = false");
  EXPECT_EQ(complaint_of(text), "");
  const std::string scale = "scale = 10";
  text.replace(text.find(scale), scale.size(), "input = false");
  EXPECT_NE(complaint_of(text).find("line 6: every [[state]] has input = false"), std::string::npos)
      << complaint_of(text);
}

TEST(ReadRobot, SaysEverythingThatIsWrongAtOnce) {
  std::string text = with("dt_s = 0.1", "dt_s = 0");
  text += "[polcy]\n";
  const std::string complaint = complaint_of(text);
  EXPECT_NE(complaint.find("dt_s = 0"), std::string::npos);
  EXPECT_NE(complaint.find("unknown key 'polcy'"), std::string::npos);
}

TEST(ReadRobot, NamesThePartsThatAreMissing) {
  const std::string complaint = complaint_of("format = 1\nname = \"empty\"\ndt_s = 0.1\nhorizon = 20\n");
  for (const char* said :
       {"[[state]] is missing: states that the robot measures", "[[action]] is missing: actions that move the robot",
        "[reward] is missing: the reward of each step"})
    EXPECT_NE(complaint.find(said), std::string::npos) << complaint;
}

TEST(ReadRobot, WhatFollowsFromAnErrorIsNotSaid) {
  EXPECT_EQ(complaint_of(with("m = 1, l", "m = \"1\", l")), "swing.toml: line 33: m must be a number");
}

}  // namespace
}  // namespace rehearse::robot_file
