#include "rehearse/learners/pilco/policy_search.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "learner.hpp"
#include "rehearse/learners/pilco/initial_policy.hpp"
#include "rehearse/learners/pilco/model.hpp"

namespace rehearse::learners::pilco {
namespace {

using slider::asked_after, slider::builder, slider::learn, slider::rbf, slider::run_trial, slider::setting,
    slider::task;

// No policy has a value on a model that throws the state out of all numbers.
TEST(PolicySearch, KeepsTheStartWhereNothingHasAValue) {
  moments::MomentTerm wild{.centres = Matrix{{1, 0}}, .log_lengths = Vector{{9, 9}}, .weights = Vector{{1e300}}};
  const auto dynamics = std::make_shared<const moments::MomentMatching>(std::vector{wild}, 1);
  const auto policy = rbf();
  const Task task = slider::task();
  const Vector start = initial_policy(*policy, start_state(task, {}), {.seed = 1, .trial = 2});
  const SearchResult found = search_policy({dynamics, *policy, task, serial_evaluator(), {}}, start, {});
  EXPECT_EQ(found.theta, start);
  EXPECT_FALSE(found.predicted_return.has_value());
  EXPECT_EQ(found.failed, found.evaluations);
}

TEST(PolicySearch, TakesTheBestOfItsRestarts) {
  const auto dynamics =
      pilco::learn({task(), asked_after(2, {{"search.line_searches", "5"}}).data, ModelOptions{}, serial_evaluator()},
                   {})
          .moments;
  const auto policy = rbf();
  const Task task = slider::task();
  const SearchProblem problem{dynamics, *policy, task, serial_evaluator(), {}};
  const SearchOptions options{.bfgs = {.line_searches = 30}, .restarts = 3};
  const auto first_policy = [&](std::uint64_t candidate) {
    return initial_policy(*policy, start_state(task, options), {.seed = 1, .trial = 2, .candidate = candidate});
  };
  const StreamKey key{.seed = 1, .trial = 2};
  std::vector<SearchResult> all{search_policy(problem, first_policy(0), options)};
  Index evaluations = all.front().evaluations;
  for (const std::uint64_t candidate : {1, 2, 3})
    evaluations += all.emplace_back(search_policy(problem, first_policy(candidate), options)).evaluations;
  const auto& best = *std::max_element(all.begin(), all.end(), [](const SearchResult& a, const SearchResult& b) {
    return a.predicted_return < b.predicted_return;
  });
  const SearchResult found = search_with_restarts(problem, first_policy(0), options, {key});
  EXPECT_EQ(found.theta, best.theta);
  EXPECT_EQ(found.predicted_return, best.predicted_return);
  EXPECT_EQ(found.evaluations, evaluations);

  const double promised = *all.front().predicted_return;
  const SearchResult disappointed = search_with_restarts(problem, first_policy(0), options, {key}, promised - 1000);
  const auto& other = *std::max_element(all.begin() + 1, all.end(), [](const SearchResult& a, const SearchResult& b) {
    return a.predicted_return < b.predicted_return;
  });
  EXPECT_EQ(disappointed.theta, other.theta);
  EXPECT_EQ(disappointed.predicted_return, other.predicted_return);
  const SearchResult surprised = search_with_restarts(problem, first_policy(0), options, {key}, promised + 1000);
  EXPECT_EQ(surprised.theta, best.theta);
  EXPECT_EQ(surprised.predicted_return, best.predicted_return);

  SearchOptions none = options;
  none.restarts = 0;
  EXPECT_EQ(search_with_restarts(problem, first_policy(0), none, {key}).theta, all.front().theta);
  const Restarts known{.key = key, .policies = {first_policy(1), first_policy(2)}};
  EXPECT_EQ(search_with_restarts(problem, first_policy(0), none, known).evaluations, all.front().evaluations);
}

// Two of four, those of the highest value on the model.
TEST(PolicySearch, RestartsFromTheBestOfThePoliciesThatAreGiven) {
  const auto dynamics =
      pilco::learn({task(), asked_after(2, {{"search.line_searches", "5"}}).data, ModelOptions{}, serial_evaluator()},
                   {})
          .moments;
  const auto policy = rbf();
  const Task task = slider::task();
  const SearchProblem problem{dynamics, *policy, task, serial_evaluator(), {}};
  const SearchOptions options{.bfgs = {.line_searches = 3}, .restarts = 2};
  const auto value = [&](const Vector& theta) {
    moments::ReturnWorkspace workspace;
    return moments::ExpectedReturn(task, *policy, dynamics)(theta, nullptr, workspace).value;
  };
  std::vector<Vector> given;
  for (const std::uint64_t k : {1, 2, 3, 4})
    given.push_back(initial_policy(*policy, start_state(task, options), {.seed = k}) * (k == 2 ? 5 : 1));
  std::vector<Vector> sorted = given;
  std::ranges::sort(sorted, std::greater(), value);
  ASSERT_GT(value(sorted[0]), value(sorted[3]));
  const Vector start = given[0];
  SearchResult best = search_policy(problem, start, options);
  Index evaluations = best.evaluations + 4;
  for (const Vector& theta : {sorted[0], sorted[1]}) {
    SearchResult other = search_policy(problem, theta, options);
    evaluations += other.evaluations;
    if (other.predicted_return > best.predicted_return) best = other;
  }
  const SearchResult found = search_with_restarts(problem, start, options, {.policies = given});
  EXPECT_EQ(found.theta, best.theta);
  EXPECT_EQ(found.predicted_return, best.predicted_return);
  EXPECT_EQ(found.evaluations, evaluations);
}

TEST(PolicySearch, ReportsProgressAndPassesInterruptions) {
  const auto learner_with = [](ProgressSink sink) {
    Setting with = setting();
    with.progress = std::move(sink);
    return builder()->build(with);
  };
  std::vector<Progress> events;
  const auto learner = learner_with([&](const Progress& p) { events.push_back(p); });
  learn(*learner, 2);
  ASSERT_GT(events.size(), 2U);
  EXPECT_EQ(events.front().phase, "model");
  EXPECT_EQ(events.back().phase, "search");
  EXPECT_EQ(events.back().rollouts, static_cast<Index>(events.size()) - 1);

  bool stop = true;
  const auto stopped = learner_with([&](const Progress& p) {
    if (stop && p.phase == "search" && p.rollouts == 3) throw Interrupted();
  });
  stopped->tell(run_trial(stopped->ask(), 1));
  EXPECT_THROW(stopped->ask(), Interrupted);
  stop = false;
  EXPECT_EQ(stopped->ask().theta, learn(*learner_with({}), 2).proposals.back().theta);
}

}  // namespace
}  // namespace rehearse::learners::pilco
