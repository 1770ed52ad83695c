#include "rehearse/recording/plausible.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/test/test_tools.hpp"

namespace rehearse::recording {
namespace {

Channel channel_of(const std::string& name, double dt_s, Index count, const std::function<double(double)>& value) {
  Channel channel{name, "rad", {}};
  for (Index i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) * dt_s;
    channel.samples.push_back({t, value(t), i + 2});
  }
  return channel;
}

TEST(Unwrap, AnglesThatKeepWithinATurnGoOn) {
  const auto wrapped = [](double t) { return std::remainder(3 * t, 2 * std::numbers::pi); };
  Channel angle = channel_of("q", 0.1, 100, wrapped);
  EXPECT_EQ(unwrap(angle, 0), 5);  // 3 · 9.9 rad are 4.7 turns, of which the first ends at half
  for (const Sample& sample : angle.samples) EXPECT_NEAR(sample.value, 3 * sample.time_s, 1e-12);
  EXPECT_EQ(unwrap(angle, 0), 0);
}

TEST(Unwrap, AnglesWithinATurnBeginInThatOfTheStart) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const auto from_0 = [](double t) { return std::sin(3 * t) - 0.1; };
  Channel angle = channel_of("q", 0.1, 100, [&](double t) { return from_0(t) + (from_0(t) < 0 ? kTurn : 0); });
  EXPECT_GT(unwrap(angle, -0.1), 5);
  for (const Sample& sample : angle.samples) EXPECT_NEAR(sample.value, from_0(sample.time_s), 1e-12);
  Channel still = channel_of("q", 0.1, 100, [](double) { return 6.2; });
  EXPECT_EQ(unwrap(still, 0), 0);
  EXPECT_EQ(still.samples.back().value, 6.2 - kTurn);
  Channel counts_on = channel_of("q", 0.1, 100, [](double) { return 6.4; });
  EXPECT_EQ(unwrap(counts_on, 0), 0);
  EXPECT_EQ(counts_on.samples.back().value, 6.4);
}

TEST(MoveBeside, AddsWholeTurnsToAll) {
  Channel angle = channel_of("q", 0.1, 3, [](double t) { return 1 + t; });
  move_beside(angle, 1 + 4 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(angle.samples[2].value, 1.2 + 4 * std::numbers::pi);
}

TEST(Bounds, RoundingIsClippedAndMoreIsAProblem) {
  Channel action{"u", "N", {{0, 2.0001, 2}, {1, -2, 3}, {2, 3, 4}, {3, 0.5, 5}}};
  Problems problems("f");
  std::vector<std::string> notes;
  keep_in_bounds(action, {-2, 2}, problems, notes);
  EXPECT_FALSE(problems.empty());
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(action.samples[0].value, 2);
  EXPECT_EQ(action.samples[3].value, 0.5);
}

/// True if there is a jump, judged without a rate.
bool jumps(const Channel& channel, const std::vector<Channel>& actions = {}) {
  Problems problems("f");
  check_jumps(channel, nullptr, actions, problems);
  return !problems.empty();
}

TEST(Jumps, MotionsOfRobotsHaveNone) {
  Rng rng({.seed = 3});
  const auto bang = [](double t) { return std::fmod(t, 1) < 0.5 ? 5.0 : -5.0; };
  EXPECT_FALSE(jumps(channel_of("v", 0.05, 100, bang)));
  const auto at_rest = [&](double t) { return 0.01 * rng.normal() + (t > 29 ? std::sin(9 * (t - 29)) : 0); };
  EXPECT_FALSE(jumps(channel_of("v", 0.002, 15000, at_rest)));
  EXPECT_FALSE(jumps(channel_of("v", 0.002, 1000, [](double) { return 0; })));
  EXPECT_FALSE(jumps(channel_of("v", 0.1, 40, [&](double) { return rng.normal(); })));
}

TEST(Jumps, AStateAtRestMayFlickerByTheResolutionOfItsSensor) {
  Channel speed = channel_of("dq", 0.02, 100, [](double) { return 0; });
  speed.samples[7].value = -0.15;
  EXPECT_FALSE(jumps(speed)) << "one step of an encoder, and back";
  speed.samples[60].value = 0.15;
  EXPECT_FALSE(jumps(speed));
  speed.samples[80].value = 9;
  EXPECT_TRUE(jumps(speed));
}

TEST(Jumps, APushIsNone) {
  const Channel coasting = channel_of("v", 0.1, 30, [](double t) { return t > 1.45 ? std::exp(1.5 - t) : 0; });
  const auto push = [](double from, double to) {
    return channel_of("u", 0.1, 29, [=](double t) { return t > from && t < to ? 5 : 0.01; });
  };
  EXPECT_TRUE(jumps(coasting));
  EXPECT_TRUE(jumps(coasting, {push(0.45, 0.55)})) << "at another time";
  EXPECT_TRUE(jumps(coasting, {channel_of("u", 0.1, 29, [](double t) { return std::sin(9 * t); })}));
  EXPECT_FALSE(jumps(coasting, {push(1.35, 1.45)}));
  EXPECT_FALSE(jumps(coasting, {push(1.25, 1.35)})) << "a step late";
  Channel wrong = coasting;
  wrong.samples[25].value = 9;
  EXPECT_TRUE(jumps(wrong, {push(1.35, 1.45)}));
}

TEST(Jumps, SamplesThatAreWrongAreFound) {
  const auto swing = [](double t) { return std::sin(5 * t); };
  const Channel rate = channel_of("dq", 0.05, 60, [](double t) { return 5 * std::cos(5 * t); });
  for (const auto& [at, to] : {std::pair{20, 30.0}, {40, -5.0}, {59, 9.0}}) {
    Channel wrong = channel_of("q", 0.05, 60, swing);
    wrong.samples[static_cast<std::size_t>(at)].value = to;
    EXPECT_TRUE(jumps(wrong)) << to;
    Problems problems("f");
    check_jumps(wrong, &rate, {}, problems);
    EXPECT_FALSE(problems.empty()) << to;
  }
  Channel shifted = channel_of("q", 0.05, 60, swing);  // an encoder that loses its zero
  for (std::size_t i = 30; i < 60; ++i) shifted.samples[i].value += 2;
  Problems problems("f");
  check_jumps(shifted, &rate, {}, problems);
  EXPECT_FALSE(problems.empty());
}

TEST(Jumps, OfAStateWithoutAUnitAreSaidWithoutOne) {
  Channel level = channel_of("level", 1, 60, [](double t) { return t; });
  level.unit = "";
  level.samples[10].value = 500;
  Problems problems("f");
  check_jumps(level, nullptr, {}, problems);
  const std::string said = message_of<InvalidInput>([&] { problems.throw_if_any(); });
  EXPECT_NE(said.find("level jumps from 9 to 500 in 1 s"), std::string::npos) << said;
}

TEST(Rates, AreComparedWhereSamplesAre) {
  const Channel state = channel_of("q", 0.05, 60, [](double t) { return std::sin(5 * t); });
  for (const auto& [rate, expected] : {std::pair{5.0, 0U}, {-5.0, 1U}}) {
    const double times = rate;
    std::vector<std::string> notes;
    compare_with_rate(state, channel_of("dq", 0.07, 50, [=](double t) { return times * std::cos(5 * t); }), 0.05,
                      notes);
    EXPECT_EQ(notes.size(), expected) << rate;
  }
}

TEST(Turns, DegreesThatAreReadAsRadAreNoted) {
  const auto notes_on = [](double unit) {
    std::vector<std::string> notes;
    look_for_turns(channel_of("q", 0.05, 60, [=](double t) { return unit * 0.5 * std::sin(5 * t); }), notes);
    return notes;
  };
  EXPECT_EQ(notes_on(1).size(), 0U);
  ASSERT_EQ(notes_on(180 / std::numbers::pi).size(), 1U);
  EXPECT_EQ(notes_on(180 / std::numbers::pi)[0].find("q changes by up to 7.14 rad from row to row"), 0U)
      << notes_on(180 / std::numbers::pi)[0];
}

}  // namespace
}  // namespace rehearse::recording
