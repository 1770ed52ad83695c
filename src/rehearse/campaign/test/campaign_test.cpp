#include "rehearse/campaign/campaign.hpp"

#include <chrono>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "rehearse/campaign/folder.hpp"
#include "rehearse/campaign/summary.hpp"
#include "rehearse/campaign/test/counting_listener.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/run.hpp"
#include "rehearse/experiment/test/fake.hpp"
#include "rehearse/files/write.hpp"
#include "rehearse/statistics/table.hpp"

namespace rehearse::campaign {
namespace {

namespace fs = std::filesystem;

const std::string kHead = "format = 1\nscenario = \"line\"\nlearners = [\"echo\", \"echo-alone\", \"pilco\"]\n";
const std::string kGrid = kHead + "priors = [\"near\", \"far\"]\nseeds = \"1-2\"\ntrials = 2\n";
const std::string kClaim = "[[claim]]\ntext = \"it works\"\nlearner = \"echo\"\nsolved_by = 2\nat_least_runs = 1\n";

Campaign run(const fs::path& folder, const std::string& text = kGrid, const CampaignOptions& options = {.threads = 1}) {
  return run_campaign(experiment::fake::catalogue(), text, "c.toml", folder, options);
}

std::string refusal(const fs::path& folder, const std::string& text) {
  return experiment::fake::message_of<InvalidInput>([&] { run(folder, text); });
}

nlohmann::json summary_of(const fs::path& folder) {
  return nlohmann::json::parse(files::read_file(folder / "summary.json"));
}

/// What must not depend on how the campaign came about.
std::string results_of(const fs::path& folder) {
  return files::read_file(folder / "campaign.csv") + files::read_file(folder / "summary.json");
}

TEST(Campaign, CsvHasARowForEveryTrialInTheOrderOfTheFile) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  EXPECT_TRUE(run(folder).complete());
  const statistics::Table table = statistics::read_csv(files::read_file(folder / "campaign.csv"));
  EXPECT_EQ(table.header,
            (std::vector<std::string>{"run", "scenario", "learner", "prior", "variant", "seed", "trial",
                                      "interaction_s", "return", "solved", "predicted_return", "rollouts",
                                      "failed_rollouts", "log_evidence", "phi.gain", "phi.gain.low", "phi.gain.high"}));
  ASSERT_EQ(table.rows.size(), 12u);
  EXPECT_EQ(table.rows[3][0], "line-echo-near-2");
  EXPECT_EQ(table.rows[3][6], "2");
  EXPECT_EQ(table.rows[11][0], "line-echo-alone-none-2");
  EXPECT_EQ(table.rows[11][3], "");

  const statistics::Table one = statistics::read_csv(files::read_file(folder / "runs/line-echo-near-2/trials.csv"));
  EXPECT_EQ(std::vector<std::string>(table.rows[3].begin() + 6, table.rows[3].end()), one.rows[1]);
  EXPECT_EQ(files::read_file(folder / "campaign.toml"), kGrid);
}

TEST(Campaign, SummaryHoldsRunsGroupsAndClaims) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  const Campaign campaign = run(folder, kGrid + kClaim);
  const auto summary = summary_of(folder);
  EXPECT_EQ(summary["format"], 1);
  EXPECT_EQ(summary["complete"], true);
  EXPECT_EQ(summary["counts"], (nlohmann::json{{"runs", 6}, {"done", 6}, {"failed", 0}, {"unfinished", 0}}));
  EXPECT_EQ(summary["missing"][0]["learner"], "pilco");
  EXPECT_EQ(summary["priors"], (nlohmann::json{"near", "far", ""}));
  ASSERT_EQ(summary["runs"].size(), 6u);
  EXPECT_EQ(summary["runs"][5]["folder"], "runs/line-echo-alone-none-2");
  EXPECT_EQ(summary["runs"][5]["state"], "done");
  ASSERT_EQ(summary["groups"].size(), 3u);
  const auto& trial = summary["groups"][1]["trials"][1];
  EXPECT_EQ(trial["runs"], 2);
  EXPECT_EQ(trial["interaction_s"], 2.4);
  EXPECT_EQ(trial["solved_by"]["runs"], 2);
  std::vector<double> returns;
  for (std::size_t seed = 0; seed < 2; ++seed) returns.push_back(campaign.outcome(1, seed).returns[1]);
  EXPECT_EQ(trial["return"]["median"], statistics::median(returns));
  EXPECT_EQ(summary["claims"][0]["text"], "it works");
  EXPECT_EQ(summary["claims"][0]["kind"], "success");
  EXPECT_EQ(summary["claims"][0]["parts"].size(), 2u);
  EXPECT_EQ(summary["claims"][0]["parts"][1]["priors"], nlohmann::json{"far"});
}

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

TEST(Campaign, RunsThatEndOnceSolvedCountAsTheyEnded) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  const std::string grid = kHead + "priors = [\"near\"]\nseeds = \"1-3\"\ntrials = 8\n" + kClaim;
  const Campaign ended = run(folder, "until_solved = true\n" + grid);
  EXPECT_TRUE(ended.complete());
  const auto counts = [&](const char* trial_measure) {
    std::vector<Index> all;
    const auto summary = summary_of(folder);
    for (const auto& group : summary["groups"])
      for (const auto& trial : group["trials"]) all.push_back(trial[trial_measure]["count"]);
    return all;
  };
  const std::vector<Index> solved_by = counts("solved_by");
  EXPECT_EQ(solved_by.size(), 16u);
  EXPECT_EQ(counts("solved"), solved_by);
  Index ended_early = 0;
  for (const RunOutcome& outcome : ended.runs) {
    ended_early += outcome.done() < 8;
    for (Index trial = 1; trial < outcome.done(); ++trial) EXPECT_FALSE(*outcome.solved[trial - 1]);
    EXPECT_EQ(outcome.row_of(8), outcome.done() - 1);
  }
  EXPECT_GT(ended_early, 0);
  const auto parts = summary_of(folder)["claims"][0]["parts"];
  EXPECT_TRUE(run(folder, grid).complete());  // goes on
  EXPECT_EQ(counts("solved_by"), solved_by);
  EXPECT_EQ(summary_of(folder)["claims"][0]["parts"], parts);
  run(folder.string() + "-whole", grid);
  EXPECT_EQ(results_of(folder), results_of(folder.string() + "-whole"));
}

/// In a process of its own that kills itself at a learner's call; true if it did.
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

TEST(Campaign, AFailureIsRecordedAndDoesNotStopTheOthers) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  const std::string text = kHead + "seeds = \"1-2\"\ntrials = 8\n[vary]\nbreaks = [false, true]\n";
  const Campaign campaign = run(folder, text, {.threads = 2});
  EXPECT_EQ(campaign.count(RunState::failed), 4);
  EXPECT_EQ(campaign.count(RunState::done), 4);
  const auto failed = summary_of(folder)["runs"][2];
  EXPECT_EQ(failed["state"], "failed");
  EXPECT_NE(failed["reason"].get<std::string>().find("the plant failed: the wheel came off"), std::string::npos);
  const std::string before = results_of(folder);
  run(folder, text);  // tries again, in vain
  EXPECT_EQ(results_of(folder), before);
}

TEST(Campaign, FailedRunsCountAsNotSolvedAndKeepTheirRows) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  const Campaign campaign = run(folder, kHead + "seeds = \"1-2\"\ntrials = 8\n[vary]\nbreaks = [false, true]\n");
  const RunOutcome& failed = campaign.outcome(1, 0);
  ASSERT_LT(failed.done(), 8);
  const auto rows = statistics::read_csv(files::read_file(folder / "campaign.csv"));
  Index kept = 0;
  for (const auto& row : rows.rows) kept += row[0] == campaign.plan.run(1, 0).name;
  EXPECT_EQ(kept, failed.done());
  const std::vector<TrialStatistics> trials = trial_statistics(campaign, 1);
  ASSERT_FALSE(trials.empty());
  EXPECT_EQ(trials.back().solved_by->runs, 2);
}

/// A complete campaign with damage: what `damage` does to it.
template <class Damage>
Campaign after(const fs::path& folder, Damage damage) {
  run(folder);
  damage(folder / "runs");
  return run(folder);
}

TEST(Campaign, ATableThatWasCutIsWrittenAgain) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  run(folder);
  const std::string before = results_of(folder);
  for (const std::string name : {"trials.csv", "done", "policy.json"}) {
    const fs::path file = folder / "runs/line-echo-far-1" / name;
    fs::resize_file(file, fs::file_size(file) - 1);
    if (name == "done") fs::remove(file);
    EXPECT_TRUE(run(folder).complete());
    EXPECT_EQ(results_of(folder), before) << name;
  }
}

TEST(Campaign, DamagedFoldersAreNamedAndLeftAlone) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  std::string before;
  const Campaign campaign = after(folder, [&](const fs::path& runs) {
    before = files::read_file(runs / "line-echo-near-1/checkpoint");
    fs::resize_file(runs / "line-echo-near-1/checkpoint", before.size() / 2);
    files::write_file(runs / "line-echo-near-2/spec.toml", "format = 7\n[run]\n");
    files::write_file(runs / "line-echo-far-1/spec.toml", files::read_file(runs / "line-echo-near-1/spec.toml"));
    fs::remove_all(runs / "line-echo-far-2");
    files::write_file(runs / "line-echo-far-2", "a file\n");
  });
  EXPECT_EQ(campaign.count(RunState::failed), 4);
  const auto reason = [&](std::size_t i) { return campaign.runs[i].reason; };
  EXPECT_NE(reason(0).find("the checkpoint is truncated or damaged"), std::string::npos) << reason(0);
  EXPECT_NE(reason(1).find("format 7 is that of another version"), std::string::npos) << reason(1);
  EXPECT_NE(reason(2).find("other options: it is of another campaign or version"), std::string::npos) << reason(2);
  EXPECT_NE(reason(3).find("cannot read"), std::string::npos) << reason(3);
  EXPECT_EQ(files::read_file(folder / "runs/line-echo-near-1/checkpoint"), before.substr(0, before.size() / 2));
  EXPECT_EQ(statistics::read_csv(files::read_file(folder / "campaign.csv")).rows.size(), 12u - 4 * 2);
  EXPECT_EQ(summary_of(folder)["groups"][0]["failed"], 2);
}

TEST(Campaign, AFolderThatCannotBeReadIsAFailedRun) {
  const Campaign campaign = after(experiment::fake::test_folder() / "campaign", [](const fs::path& runs) {
    fs::remove(runs / "line-echo-near-2/trials.csv");
    fs::create_symlink("trials.csv", runs / "line-echo-near-2/trials.csv");  // to itself
  });
  EXPECT_EQ(campaign.count(RunState::failed), 1);
  EXPECT_EQ(campaign.runs[1].state, RunState::failed);
  EXPECT_NE(campaign.runs[1].reason.find("line-echo-near-2/trials.csv: Too many levels of symbolic links"),
            std::string::npos)
      << campaign.runs[1].reason;
}

TEST(Campaign, StrangersAreNamedAndSkipped) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  const Campaign campaign = after(folder, [](const fs::path& runs) {
    files::write_file(runs / "notes.txt", "mine\n");
    fs::create_directories(runs / "somebody-else");
    fs::create_directories(runs / ".line-echo-near-1.12345/trajectories");  // of a run killed while it was made
  });
  ASSERT_EQ(campaign.skipped.size(), 2u);
  EXPECT_EQ(campaign.skipped[0].path, "runs/notes.txt");
  EXPECT_EQ(campaign.skipped[1].path, "runs/somebody-else");
  EXPECT_EQ(summary_of(folder)["skipped"][0]["reason"], "not a run of this campaign");
  EXPECT_TRUE(fs::exists(folder / "runs/notes.txt"));
  EXPECT_FALSE(fs::exists(folder / "runs/.line-echo-near-1.12345"));
}

TEST(Campaign, TemporariesOfAKilledStartGoWhenNobodyElseIsAtWork) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  fs::create_directories(folder);
  files::write_file(folder / "campaign.toml.0123abcd.tmp", "for");
  run_campaign(experiment::fake::catalogue(), kGrid, "c.toml", folder, {.threads = 1, .share = {.number = 1, .of = 4}});
  EXPECT_TRUE(fs::exists(folder / "campaign.toml.0123abcd.tmp")) << "another share may be writing it";
  run(folder);
  EXPECT_FALSE(fs::exists(folder / "campaign.toml.0123abcd.tmp"));
}

// A link to itself stands for whatever a network file system says while a file is replaced.
TEST(Campaign, ARankThatJoinsWaitsUntilItSeesTheFile) {
  const fs::path folder = experiment::fake::test_folder();
  fs::create_symlink("campaign.toml", folder / "campaign.toml");
  std::thread first([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    files::write_file(folder / "campaign.toml", "old");
    files::write_file(folder / "campaign.toml", kGrid);
  });
  EXPECT_EQ(CampaignFolder::join(folder, kGrid).path(), folder);
  first.join();
}

TEST(Campaign, AFileThatOnlyAddsExtendsTheFolder) {
  const fs::path folder = experiment::fake::test_folder();
  const std::string more = kHead + "priors = [\"far\", \"near\"]\nseeds = \"1-3\"\ntrials = 3\n" + kClaim;
  run(folder / "grown");
  run(folder / "grown", more);
  run(folder / "whole", more);
  EXPECT_EQ(results_of(folder / "grown"), results_of(folder / "whole"));
  EXPECT_EQ(files::read_file(folder / "grown/campaign.toml"), more);
}

TEST(Campaign, AFileThatAsksForSomethingElseIsRefused) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  run(folder);
  const std::string before = results_of(folder) + files::read_file(folder / "campaign.toml");
  const std::string name = folder.string();
  EXPECT_EQ(refusal(folder, kHead + "seeds = \"2-3\"\ntrials = 1\n[set]\nsearch.step = 1\n"),
            name +
                " was begun with line-echo-near-1 and 3 other runs, which the campaign file no longer has; name "
                "another folder\n" +
                name + " was begun with other options of line-echo-near-2 and 1 other run; name another folder\n" +
                name + " was begun with 2 trials, the campaign file has 1; name another folder");
  EXPECT_EQ(results_of(folder) + files::read_file(folder / "campaign.toml"), before);
}

TEST(Campaign, OtherFoldersAreRefused) {
  const fs::path folder = experiment::fake::test_folder();
  fs::create_directories(folder / "mine");
  files::write_file(folder / "mine/thesis.txt", "x");
  files::write_file(folder / "file", "x");
  EXPECT_NE(refusal(folder / "mine", kGrid).find("is not the folder of a campaign"), std::string::npos);
  EXPECT_NE(refusal(folder / "file", kGrid).find("is not a folder"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "mine/lock"));

  fs::create_directories(folder / "empty");
  EXPECT_TRUE(run(folder / "empty/").complete());
  const files::FolderLock lock(folder / "empty");
  EXPECT_NE(refusal(folder / "empty", kGrid).find("in use"), std::string::npos);
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
  EXPECT_EQ(statistics::read_csv(files::read_file(folder / "campaign.csv")).rows.size(), 0u);
}

TEST(Campaign, TellsItsListener) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  CountingListener first, second;
  run(folder, kGrid, {.threads = 2, .listener = &first});
  EXPECT_EQ(first.at_once, 2);
  EXPECT_EQ(first.begun, 6);
  EXPECT_EQ(first.progressed, 12);
  EXPECT_EQ(first.ended, 6);
  run(folder, kGrid, {.threads = 2, .listener = &second});
  EXPECT_EQ(second.at_once, 0);
  EXPECT_EQ(second.begun, 0);
}

}  // namespace
}  // namespace rehearse::campaign
