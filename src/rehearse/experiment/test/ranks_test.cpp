// Runs on several ranks, which here are threads.
#include "rehearse/core/ranks.hpp"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "fake.hpp"
#include "rank_ends.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/run.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

Spec line_spec(Index trials) { return {.scenario = "line", .learner = "echo", .trials = trials, .seed = 3}; }

std::string run_results(const fs::path& folder) {
  std::string bytes;
  for (const std::string name : {"spec.toml", "trials.csv", "errors.csv", "policy.json", "done",
                                 "trajectories/trial-001.csv", "predictions/trial-002.csv"})
    bytes += name + "\n" + files::read_file(folder / name);
  return bytes;
}

/// The catalogue, in which the plants that are made are counted.
Catalogue counting_catalogue(std::atomic<int>& plants) {
  return fake::catalogue_with([&plants](fake::MakePlant make) { return [&plants, make] { return ++plants, make(); }; });
}

TEST(RunOnRanks, SameBytesAndOnePlant) {
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(4), folder / "alone", {});
  std::atomic<int> plants{0};
  const Catalogue catalogue = counting_catalogue(plants);
  const fake::Ends ends([&](Ranks&, const RunOptions& options) {
    EXPECT_EQ(start_run(catalogue, line_spec(4), folder / "ranks", options).trials, 4);
  });
  EXPECT_EQ(ends.all(), "done");
  EXPECT_EQ(plants, 1);
  EXPECT_EQ(run_results(folder / "ranks"), run_results(folder / "alone"));
}

TEST(RunOnRanks, StoppedAnywhereAndResumed) {
  const fs::path folder = fake::test_folder();
  Spec spec = line_spec(4);
  spec.options = {{"evaluations", "2"}};
  start_run(fake::catalogue(), spec, folder / "alone", {});
  int interrupted = 0;
  for (int stops = 0; stops < 30; stops += 3) {
    const fs::path run = folder / std::to_string(stops);
    std::atomic<int> polls{0};
    const fake::Ends first([&](Ranks&, const RunOptions& options) { start_run(fake::catalogue(), spec, run, options); },
                           [&](int rank) { return rank == 1 && polls++ == stops; });
    interrupted += first.all() == "interrupted";
    EXPECT_TRUE(first.all() == "interrupted" || first.all() == "done") << first.all();
    const fake::Ends second([&](Ranks&, const RunOptions& options) {
      if (fs::exists(run / "spec.toml")) resume_run(fake::catalogue(), run, {}, options);
    });
    EXPECT_EQ(second.all(), "done");
    EXPECT_EQ(run_results(run), run_results(folder / "alone")) << stops;
  }
  EXPECT_GE(interrupted, 5);
}

TEST(RunOnRanks, ExtendedByOtherNumbersOfRanks) {
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(4), folder / "alone", {});
  start_run(fake::catalogue(), line_spec(2), folder / "ranks", {});
  const fake::Ends ends([&](Ranks&, const RunOptions& options) {
    EXPECT_EQ(resume_run(fake::catalogue(), folder / "ranks", 4, options).trials, 4);
  });
  EXPECT_EQ(ends.all(), "done");
  EXPECT_EQ(run_results(folder / "ranks"), run_results(folder / "alone"));
}

TEST(RunOnRanks, WhatFailsOnTheFirstFailsOnAll) {
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(1), folder / "there", {});
  const fake::Ends exists([&](Ranks&, const RunOptions& options) {
    start_run(fake::catalogue(), line_spec(1), folder / "there", options);
  });
  EXPECT_TRUE(exists.all().starts_with((folder / "there").string() + " already exists")) << exists.all();
  EXPECT_EQ(exists.all().find(" | "), std::string::npos);

  Spec breaks = line_spec(8);
  breaks.options = {{"breaks", "true"}};
  const fake::Ends broken([&](Ranks&, const RunOptions& options) {
    EXPECT_THROW(
        try { start_run(fake::catalogue(), breaks, folder / "breaks", options); } catch (const RunFailed& error) {
          EXPECT_NE(std::string(error.what()).find("the plant failed: the wheel came off"), std::string::npos);
          throw;
        },
        RunFailed);
  });
  EXPECT_EQ(broken.all(), "done");
}

TEST(RunOnRanks, ARankThatComesToAnotherPolicyEndsTheRun) {
  const fs::path folder = fake::test_folder();
  const fake::Ends ends([&](Ranks& ranks, const RunOptions& options) {
    Spec spec = line_spec(3);
    if (ranks.rank() == 2) spec.options = {{"search.step", "0.40000000000000013"}};
    try {
      start_run(fake::catalogue(), spec, folder / "run", options);
    } catch (const std::exception& error) {
      ranks.leave(1, error.what());
      throw;
    }
  });
  EXPECT_NE(ends.all().find("it proposes another policy than that of rank 0"), std::string::npos) << ends.all();
  EXPECT_NE(ends.all().find("rank 2 failed"), std::string::npos) << ends.all();
}

}  // namespace
}  // namespace rehearse::experiment
