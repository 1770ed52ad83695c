#include "rehearse/experiment/checkpoint.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "fake.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::experiment {
namespace {

History history_of_one() {
  History history;
  history.trials.push_back({.trial = 1,
                            .interaction_s = 0.1 + 0.2,
                            .total_reward = -0.0,
                            .solved = false,
                            .cut_short = true,
                            .limits = {{"track", 0.05, 0.1, {0.01, 0.2}, true}, {.limit = "speed", .allowed = 0.5}},
                            .rollouts = 5,
                            .log_evidence = -kInf,
                            .phi = {1.0 / 3, std::nan("")},
                            .phi_intervals = {Interval{0.1, 1.0 / 3}, std::nullopt},
                            .warnings = {"b is not determined"},
                            .policy = "line",
                            .theta = Vector::Constant(3, 5e-324),
                            .forecast = {{.horizon = 2, .compared = 3, .failed = 1, .rms = Vector::Constant(1, 0.1)}},
                            .notes = {"ünïcode"}});
  Episode episode;
  episode.states = Matrix::Random(3, 2);
  episode.true_states = Matrix::Random(3, 2);
  episode.actions = Matrix::Random(2, 1);
  episode.rewards = Vector::Random(2);
  episode.charged = -7;
  episode.ended = true;
  history.episodes.push_back(episode);
  history.told = 1;
  history.learner = {{"warm", 0.1}};
  return history;
}

std::string checkpoint_complaint(const std::string& bytes, std::uint64_t spec = 42) {
  return fake::message_of<InvalidInput>([&] { from_checkpoint(bytes, spec); });
}

TEST(Checkpoint, KeepsEveryBit) {
  const History history = history_of_one(), back = from_checkpoint(to_checkpoint(history, 42), 42);
  ASSERT_EQ(back.done(), 1);
  const TrialRecord &a = history.trials[0], &b = back.trials[0];
  EXPECT_EQ(b.interaction_s, a.interaction_s);
  EXPECT_TRUE(std::signbit(b.total_reward));
  EXPECT_EQ(b.solved, a.solved);
  EXPECT_TRUE(b.cut_short);
  EXPECT_FALSE(b.predicted_return.has_value());
  EXPECT_EQ(b.log_evidence, a.log_evidence);
  EXPECT_EQ(b.phi[0], a.phi[0]);
  EXPECT_TRUE(std::isnan(b.phi[1]));
  EXPECT_EQ(b.phi_intervals[0]->low, 0.1);
  EXPECT_EQ(b.phi_intervals[0]->high, 1.0 / 3);
  EXPECT_FALSE(b.phi_intervals[1].has_value());
  EXPECT_EQ(b.warnings, a.warnings);
  ASSERT_EQ(b.limits.size(), 2u);
  EXPECT_EQ(b.limits[0].limit, "track");
  EXPECT_EQ(b.limits[0].allowed, 0.05);
  EXPECT_EQ(b.limits[0].predicted, 0.1);
  EXPECT_EQ(b.limits[0].interval.high, 0.2);
  EXPECT_TRUE(b.limits[0].broken);
  EXPECT_FALSE(b.limits[1].predicted);
  EXPECT_EQ(b.policy, a.policy);
  EXPECT_EQ(b.theta, a.theta);
  EXPECT_EQ(b.forecast[0].rms, a.forecast[0].rms);
  EXPECT_EQ(b.notes, a.notes);
  EXPECT_EQ(back.episodes[0].states, history.episodes[0].states);
  EXPECT_EQ(back.episodes[0].rewards, history.episodes[0].rewards);
  EXPECT_EQ(back.episodes[0].charged, -7);
  EXPECT_TRUE(back.episodes[0].ended);
  EXPECT_EQ(back.learner, history.learner);
  EXPECT_EQ(to_checkpoint(back, 42), to_checkpoint(history, 42));
}

TEST(Checkpoint, EveryTruncationIsRefused) {
  const std::string bytes = to_checkpoint(history_of_one(), 42);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_NE(checkpoint_complaint(bytes.substr(0, size)), "") << size;
  EXPECT_EQ(checkpoint_complaint(bytes.substr(0, bytes.size() - 1)), "the checkpoint is truncated or damaged");
}

TEST(Checkpoint, DamageAnotherVersionAndAnotherSpecAreRefused) {
  std::string bytes = to_checkpoint(history_of_one(), 42);
  EXPECT_NE(checkpoint_complaint(bytes, 43).find("belongs to another spec.toml"), std::string::npos);
  EXPECT_NE(checkpoint_complaint("rehearse-checkpoint 2 0 0\n").find("another version"), std::string::npos);
  bytes[bytes.size() / 2] ^= 1;
  EXPECT_EQ(checkpoint_complaint(bytes), "the checkpoint is truncated or damaged");
  EXPECT_EQ(checkpoint_complaint("hello"), "the checkpoint is truncated or not one of Rehearse");
}

/// The message by which the checkpoint of one trial is refused after a change; empty: it is not.
std::string complaint_after(const std::function<void(History& history)>& change) {
  History history = history_of_one();
  change(history);
  return checkpoint_complaint(to_checkpoint(history, 42));
}

TEST(Checkpoint, OneThatContradictsItselfIsRefused) {
  const std::string told = "the checkpoint contradicts itself: the learner was told ";
  EXPECT_EQ(complaint_after([](History& h) { h.told = -1; }),
            told + "-1 of 1 trials, must be all but perhaps the last");
  EXPECT_EQ(complaint_after([](History& h) { h.told = 2; }), told + "2 of 1 trials, must be all but perhaps the last");
  EXPECT_EQ(complaint_after([](History& h) { h = {}, h.told = -1; }),
            told + "-1 of 0 trials, must be all but perhaps the last");
  EXPECT_EQ(complaint_after([](History& h) { h.trials[0].trial = 1'000'000; }),
            "the checkpoint contradicts itself: trial 1 has the number 1000000");
  EXPECT_EQ(complaint_after([](History& h) { h.asked = h.trials[0]; }),
            "the checkpoint contradicts itself: trial 1 is to come after 1");
  EXPECT_EQ(complaint_after([](History& h) { h.episodes.clear(); }),
            "the checkpoint contradicts itself: 1 trials have 0 episodes");
  EXPECT_EQ(complaint_after([](History& h) { h.episodes[0].rewards.resize(1); }),
            "the checkpoint contradicts itself: trial 1 has 3 × 2 states, 3 × 2 true states and 1 rewards in 2 steps");
  for (Matrix Episode::*matrix : {&Episode::states, &Episode::true_states, &Episode::actions})
    EXPECT_NE(complaint_after([&](History& h) { (h.episodes[0].*matrix) = Matrix::Zero(1, 2); }), "");
  EXPECT_NE(complaint_after([](History& h) { h.episodes[0].true_states = Matrix::Zero(3, 1); }), "");
  EXPECT_EQ(
      complaint_after([](History& h) { h.logs.push_back({.name = "a.csv", .file_checksum = "", .episode = {}}); }),
      "the checkpoint contradicts itself: log a.csv has 0 × 0 states, 0 × 0 true states and 0 rewards in 0 steps");
}

TEST(Checkpoint, AnEpisodeMayEndBeforeItsFirstAction) {
  EXPECT_EQ(complaint_after([](History& h) {
              h.episodes[0].states = h.episodes[0].true_states = Matrix::Zero(1, 2);
              h.episodes[0].actions.resize(0, 1);
              h.episodes[0].rewards.resize(0);
              h.told = 0;
            }),
            "");
}

}  // namespace
}  // namespace rehearse::experiment
