#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "line_run.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/ask_tell.hpp"
#include "rehearse/experiment/run.hpp"
#include "rehearse/experiment/run_folder.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

using fake::line_spec, fake::lines_of, fake::results_of;

TEST(Resume, AfterAStopAnywhereGivesTheSameBytes) {
  const fs::path folder = fake::test_folder();
  Spec spec = line_spec(4);
  spec.options = {{"evaluations", "5"}};
  constexpr Index kSteps = 12, kBefore = 3 + 2 * kSteps;     // the episode is on the disk: policy, prediction, episode
  constexpr Index kPolls = kBefore + 5 * (1 + kSteps) + 10;  // of a trial: evaluations and errors over 10 steps, too
  Index polls_of_all = 0;
  start_run(fake::catalogue(), spec, folder / "whole", {.stop = [&] { return ++polls_of_all == 0; }});
  EXPECT_EQ(polls_of_all, 4 * kPolls);
  const std::string expected = results_of(folder / "whole");
  bool stopped = true;
  for (Index stops = 0; stopped; stops += 7) {
    const fs::path run = folder / ("stopped-" + std::to_string(stops));
    Index polls = 0;
    stopped = false;
    try {
      start_run(fake::catalogue(), spec, run, {.stop = [&] { return polls++ == stops; }});
    } catch (const Interrupted&) {
      stopped = true;
      EXPECT_FALSE(fs::exists(run / "done"));
      EXPECT_EQ(RunFolder::open(run).load().done(), (stops + kPolls - kBefore) / kPolls) << stops;
      resume_run(fake::catalogue(), run, {}, {});
    }
    EXPECT_EQ(results_of(run), expected) << stops;
  }
}

TEST(Resume, LeavesNoPolicyOfATrialThatIsOver) {
  const fs::path run = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(1), run, {});
  ask_run(fake::catalogue(), run, {});
  ASSERT_TRUE(fs::exists(run / "next/policy.json"));
  resume_run(fake::catalogue(), run, Until{2}, {});
  EXPECT_FALSE(fs::exists(run / "next"));
}

/// Runs in a process of its own that kills itself; true if it did.
bool run_killed(const fs::path& folder, fake::Killer killer) {
  const pid_t child = ::fork();
  if (child == 0) {
    start_run(fake::catalogue(killer), line_spec(4), folder, {});
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

TEST(Resume, AfterAKillGivesTheSameBytes) {
  using Place = fake::Killer::Place;
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(4), folder / "whole", {});
  const std::string expected = results_of(folder / "whole");
  for (Place place : {Place::ask, Place::tell, Place::save})
    for (Index call = 0; call < 4; ++call) {
      const fs::path run = folder / ("killed-" + std::to_string(static_cast<int>(place)) + std::to_string(call));
      if (!run_killed(run, {place, call})) {
        EXPECT_TRUE(place == Place::save && call == 0);  // nothing to save before the first trial
        continue;
      }
      resume_run(fake::catalogue(), run, {}, {});
      EXPECT_EQ(results_of(run), expected) << static_cast<int>(place) << " " << call;
    }
}

TEST(Resume, ExtendsARunAndNeverShrinksIt) {
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(6), folder / "six", {});
  start_run(fake::catalogue(), line_spec(2), folder / "two", {});
  EXPECT_EQ(resume_run(fake::catalogue(), folder / "two", {}, {}).trials, 2);
  EXPECT_EQ(resume_run(fake::catalogue(), folder / "two", 6, {}).trials, 6);
  EXPECT_EQ(results_of(folder / "six"), results_of(folder / "two"));
  const auto message = fake::message_of<InvalidInput>([&] { resume_run(fake::catalogue(), folder / "two", 5, {}); });
  EXPECT_NE(message.find("trials = 5, but 6 trials of"), std::string::npos) << message;
}

TEST(Resume, NamesTheNumberOfTrialsThatIsNone) {
  const fs::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(2), folder, {});
  for (const Index trials : {0, -3})
    EXPECT_EQ(fake::message_of<InvalidInput>([&] { resume_run(fake::catalogue(), folder, trials, {}); }),
              "trials = " + std::to_string(trials) + ", must be ≥ 1 where Rehearse drives the plant");
}

/// The message of what fails when the run in a folder is resumed.
bool may_resuming_help(const fs::path& folder) {
  try {
    resume_run(fake::catalogue(), folder, 9, {});
  } catch (const RunFailed& error) {
    return error.resume_may_help();
  }
  ADD_FAILURE() << "nothing failed";
  return false;
}

TEST(Resume, MayHelpWhereAFileCouldNotBeWritten) {
  const fs::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(8), folder, {});
  fs::create_directory(folder / "trials.csv.tmp");  // which a file cannot replace
  EXPECT_TRUE(may_resuming_help(folder));
  fs::remove(folder / "trials.csv.tmp");
  EXPECT_EQ(resume_run(fake::catalogue(), folder, 9, {}).trials, 9);
}

TEST(Resume, AfterAFailingPlantKeepsWhatWasDone) {
  const fs::path folder = fake::test_folder() / "run";
  Spec spec = line_spec(8);
  spec.options = {{"breaks", "true"}};
  const auto message = fake::message_of<RunFailed>([&] { start_run(fake::catalogue(), spec, folder, {}); });
  EXPECT_NE(message.find("the plant failed: the wheel came off"), std::string::npos) << message;
  const auto kept = lines_of(folder / "trials.csv").size();
  EXPECT_LT(kept, 9u);
  EXPECT_EQ(fake::message_of<RunFailed>([&] { resume_run(fake::catalogue(), folder, {}, {}); }), message);
  EXPECT_FALSE(may_resuming_help(folder)) << "it fails in the same way";
  EXPECT_EQ(lines_of(folder / "trials.csv").size(), kept);
}

}  // namespace
}  // namespace rehearse::experiment
