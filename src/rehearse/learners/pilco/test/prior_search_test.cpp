#include "rehearse/learners/pilco/prior_search.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rehearse/learners/pilco/prior_store.hpp"
#include "rehearse/learners/test/memory_store.hpp"
#include "slider.hpp"

namespace rehearse::learners::pilco {
namespace {

Setting searched_setting() {
  Setting with = slider::setting();
  with.prior = learners::slider::prior(1.2);
  with.evaluator = make_thread_evaluator(1);
  return with;
}

Options few_searches(Index searches) {
  Options options{.pi_rem = PiRemOptions{.searches = searches}};
  options.search.bfgs.line_searches = 15;
  return options;
}

TEST(PriorSearch, TakesTheBestOfItsPolicies) {
  const PriorKnowledge one = search_on_prior(searched_setting(), few_searches(1));
  const PriorKnowledge four = search_on_prior(searched_setting(), few_searches(4));
  ASSERT_EQ(four.policies.size(), 4U);
  EXPECT_EQ(four.policies[0], one.theta) << "more searches come after the same first";
  EXPECT_NE(four.policies[1], four.policies[2]);
  EXPECT_GE(*four.predicted_return, *one.predicted_return);
  EXPECT_TRUE(std::ranges::find(four.policies, four.theta) != four.policies.end());
  EXPECT_GT(four.evaluations, 2 * one.evaluations);
  EXPECT_TRUE(four.network.empty() && four.notes.empty());
}

TEST(PriorSearch, IsMadeForAWiderStartThanTheTasks) {
  Options narrow = few_searches(1), wide = few_searches(1);
  narrow.pi_rem->start_std = 0;
  wide.pi_rem->start_std = 0.3;
  EXPECT_NE(search_on_prior(searched_setting(), narrow).theta, search_on_prior(searched_setting(), wide).theta);
}

TEST(PriorSearch, GoesOnFromTheStoreAfterEachSearch) {
  const PriorKnowledge whole = search_on_prior(searched_setting(), few_searches(3));
  Setting stored = searched_setting();
  stored.store = std::make_shared<MemoryStore>();
  search_on_prior(stored, few_searches(2));
  const PriorKnowledge continued = search_on_prior(stored, few_searches(3));
  EXPECT_EQ(to_json(continued), to_json(whole));
  Index searched = 0;
  stored.progress = [&](const Progress&) { ++searched; };
  EXPECT_EQ(to_json(search_on_prior(stored, few_searches(3))), to_json(whole));
  EXPECT_EQ(searched, 0) << "all of it was kept";
}

TEST(PriorSearch, BeginsAnewWhereTheStoreHoldsSomethingElse) {
  const PriorKnowledge whole = search_on_prior(searched_setting(), few_searches(2));
  PriorKnowledge other = whole;
  other.policies[0] = Vector::Zero(3);
  for (const nlohmann::json& work : {nlohmann::json("nothing of ours"), to_json(other)}) {
    Setting stored = searched_setting();
    stored.store = std::make_shared<MemoryStore>();
    keep_work(stored, work);
    EXPECT_EQ(to_json(search_on_prior(stored, few_searches(2))), to_json(whole));
  }
}

}  // namespace
}  // namespace rehearse::learners::pilco
