#include "rehearse/campaign/campaign.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "line_campaign.hpp"
#include "rehearse/files/table.hpp"

namespace rehearse::campaign {
namespace {

namespace fs = std::filesystem;

using line::kGrid, line::refusal, line::results_of, line::run, line::summary_of;

TEST(Campaign, SameBytesForAnyNumberOfThreads) {
  const fs::path folder = experiment::fake::test_folder();
  run(folder / "one", kGrid, {.threads = 1});
  run(folder / "two", kGrid, {.threads = 2});
  run(folder / "many", kGrid, {.threads = 15});  // some runs get three, others two
  EXPECT_EQ(results_of(folder / "one"), results_of(folder / "two"));
  EXPECT_EQ(results_of(folder / "one"), results_of(folder / "many"));
}

TEST(Campaign, AfterAStopAnywhereGivesTheSameBytes) {
  const fs::path folder = experiment::fake::test_folder();
  run(folder / "whole");
  bool stopped = true;
  Index stops = 0;
  for (; stopped; stops += 4) {
    const fs::path campaign = folder / ("stopped-" + std::to_string(stops));
    Index polls = 0;
    stopped = !run(campaign, kGrid, {.threads = 1, .stop = [&] { return polls++ >= stops; }}).complete();
    EXPECT_EQ(summary_of(campaign)["complete"], !stopped);
    EXPECT_TRUE(run(campaign).complete());
    EXPECT_EQ(results_of(campaign), results_of(folder / "whole")) << stops;
  }
  EXPECT_GE(stops, 40);
}

/// Runs a campaign in a process of its own that kills itself at a learner's call; true if it did.
bool run_killed(const fs::path& folder, experiment::fake::Killer killer) {
  const pid_t child = ::fork();
  if (child == 0) {
    run_campaign(experiment::fake::catalogue(killer), kGrid, "c.toml", folder, {.threads = 1});
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

TEST(Campaign, AfterAKillGivesTheSameBytes) {
  using Place = experiment::fake::Killer::Place;
  const fs::path folder = experiment::fake::test_folder();
  run(folder / "whole");
  for (Place place : {Place::ask, Place::tell, Place::save}) {
    const fs::path campaign = folder / ("killed-" + std::to_string(static_cast<int>(place)));
    EXPECT_TRUE(run_killed(campaign, {place, 1}));
    EXPECT_FALSE(run_killed(campaign, {}));  // goes on to the end
    EXPECT_EQ(results_of(campaign), results_of(folder / "whole"));
  }
}

TEST(Campaign, AFinishedRunIsNotRepeated) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  run(folder);
  const fs::path timings = folder / "runs/line-echo-near-2/timings.csv";
  std::ofstream(timings) << "mine\n";
  fs::remove(folder / "summary.json");
  EXPECT_TRUE(run(folder).complete());
  EXPECT_EQ(files::read_file(timings), "mine\n");
  EXPECT_TRUE(fs::exists(folder / "summary.json"));
}

TEST(Campaign, ARunWhoseFolderIsInUseKeepsItsRows) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  run(folder);
  const std::string trials = "trials = ";
  std::string longer = kGrid;
  longer.insert(longer.find(trials) + trials.size(), "1");  // ten times as many, at least
  const files::FolderLock busy(folder / "runs/line-echo-near-2");
  EXPECT_FALSE(run(folder, longer).complete());
  EXPECT_NE(files::read_file(folder / "campaign.csv").find("line-echo-near-2,"), std::string::npos);
}

TEST(Campaign, WrongInputLeavesNoFolder) {
  const fs::path folder = experiment::fake::test_folder();
  EXPECT_NE(refusal(folder / "a/b", kGrid + "nonsense = 1\n"), "");
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Campaign, OfMissingLearnersAloneHasNoRuns) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  const Campaign campaign = run(folder, "format = 1\nscenario = \"line\"\nlearners = [\"pilco\"]\nseeds = 1\n");
  EXPECT_TRUE(campaign.complete());
  EXPECT_EQ(files::read_csv(files::read_file(folder / "campaign.csv")).rows.size(), 0u);
}

}  // namespace
}  // namespace rehearse::campaign
