#include "rehearse/learners/pilco/prior_knowledge.hpp"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rehearse::learners::pilco {
namespace {

PriorKnowledge knowledge() {
  const Matrix centres{{0.1, 1e-300}, {-2, 3}, {0.3, -0.7}};
  return {.network = {{.output = 1, .centres = centres, .log_lengths = Vector{{0.5, 9}}, .weights = Vector{{1, 2, 3}}},
                      {.output = 0, .centres = centres, .log_lengths = Vector{{-1, 0}}, .weights = Vector{{4, 5, 6}}}},
          .theta = Vector{{0.1 + 0.2, std::numeric_limits<double>::max()}},
          .predicted_return = 7.25,
          .evaluations = 12,
          .failed = 3,
          .notes = {"a fit, failed"}};
}

TEST(PriorKnowledge, ComesBackFromBytesAsItWas) {
  const PriorKnowledge kept = knowledge();
  const PriorKnowledge back = to_knowledge(nlohmann::json::from_cbor(nlohmann::json::to_cbor(to_json(kept))));
  ASSERT_EQ(back.network.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.network[i].output, kept.network[i].output);
    EXPECT_EQ(back.network[i].centres, kept.network[i].centres);
    EXPECT_EQ(back.network[i].log_lengths, kept.network[i].log_lengths);
    EXPECT_EQ(back.network[i].weights, kept.network[i].weights);
  }
  EXPECT_EQ(back.theta, kept.theta);
  EXPECT_EQ(back.predicted_return, 7.25);
  EXPECT_EQ(back.evaluations, 12);
  EXPECT_EQ(back.failed, 3);
  EXPECT_EQ(back.notes, kept.notes);
}

TEST(PriorKnowledge, OfNothingThatCouldBeLearnedComesBackToo) {
  const PriorKnowledge back = to_knowledge(to_json({.theta = Vector{{1}}, .notes = {"in vain"}}));
  EXPECT_TRUE(back.network.empty());
  EXPECT_FALSE(back.predicted_return);
  EXPECT_EQ(back.notes, std::vector<std::string>{"in vain"});
  nlohmann::json other = to_json(knowledge());
  other.erase("theta");
  EXPECT_THROW(to_knowledge(other), nlohmann::json::exception);
}

}  // namespace
}  // namespace rehearse::learners::pilco
