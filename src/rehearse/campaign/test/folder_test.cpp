#include "rehearse/campaign/folder.hpp"

#include <chrono>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "line_campaign.hpp"
#include "rehearse/experiment/run.hpp"
#include "rehearse/files/table.hpp"

namespace rehearse::campaign {
namespace {

namespace fs = std::filesystem;

using line::kClaim, line::kGrid, line::kThreeLearners, line::refusal, line::results_of, line::run, line::summary_of;

/// A complete campaign with damage: what `damage` does to it.
template <class Damage>
Campaign after(const fs::path& folder, Damage damage) {
  run(folder);
  damage(folder / "runs");
  return run(folder);
}

TEST(CampaignFolder, ATableThatWasCutIsWrittenAgain) {
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

TEST(CampaignFolder, DamagedFoldersAreNamedAndLeftAlone) {
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
  EXPECT_EQ(files::read_csv(files::read_file(folder / "campaign.csv")).rows.size(), 12u - 4 * 2);
  EXPECT_EQ(summary_of(folder)["groups"][0]["failed"], 2);
}

TEST(CampaignFolder, ARunThatWasExtendedByHandHasThePlannedTrials) {
  const fs::path folder = experiment::fake::test_folder() / "campaign", extended = folder / "runs/line-echo-far-1";
  run(folder);
  const std::string before = results_of(folder);
  experiment::resume_run(experiment::fake::catalogue(), extended, experiment::Until(3), {});
  fs::remove(extended / "done");  // as if it had been interrupted
  EXPECT_TRUE(run(folder).complete());
  EXPECT_EQ(results_of(folder), before);
}

TEST(CampaignFolder, ARunOfAnOlderVersionMayLackAnOption) {
  const fs::path folder = experiment::fake::test_folder() / "campaign",
                 spec = folder / "runs/line-echo-near-1/spec.toml";
  run(folder);
  const std::string before = results_of(folder), text = files::read_file(spec);
  const auto line = text.find("search.step"), end = text.find('\n', line);
  ASSERT_NE(line, std::string::npos);
  files::write_file(spec, text.substr(0, line) + text.substr(end + 1));
  EXPECT_TRUE(run(folder).complete());
  EXPECT_EQ(results_of(folder), before);
}

TEST(CampaignFolder, AFolderThatCannotBeReadIsAFailedRun) {
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

TEST(CampaignFolder, StrangersAreNamedAndSkipped) {
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

TEST(CampaignFolder, TemporariesOfAKilledStartGoWhenNobodyElseIsAtWork) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  fs::create_directories(folder);
  files::write_file(folder / "campaign.toml.0123abcd.tmp", "for");
  run_campaign(experiment::fake::catalogue(), kGrid, "c.toml", folder, {.threads = 1, .share = {.number = 1, .of = 4}});
  EXPECT_TRUE(fs::exists(folder / "campaign.toml.0123abcd.tmp")) << "another share may be writing it";
  run(folder);
  EXPECT_FALSE(fs::exists(folder / "campaign.toml.0123abcd.tmp"));
}

// A link to itself stands for whatever a network file system says while a file is replaced.
TEST(CampaignFolder, ARankThatJoinsWaitsUntilItSeesTheFile) {
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

TEST(CampaignFolder, AFileThatOnlyAddsExtendsTheFolder) {
  const fs::path folder = experiment::fake::test_folder();
  const std::string more = kThreeLearners + "priors = [\"far\", \"near\"]\nseeds = \"1-3\"\ntrials = 3\n" + kClaim;
  run(folder / "grown");
  run(folder / "grown", more);
  run(folder / "whole", more);
  EXPECT_EQ(results_of(folder / "grown"), results_of(folder / "whole"));
  EXPECT_EQ(files::read_file(folder / "grown/campaign.toml"), more);
}

TEST(CampaignFolder, AFileThatAsksForSomethingElseIsRefused) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  run(folder);
  const std::string before = results_of(folder) + files::read_file(folder / "campaign.toml");
  const std::string name = folder.string();
  EXPECT_EQ(refusal(folder, kThreeLearners + "seeds = \"2-3\"\ntrials = 1\n[set]\nsearch.step = 1\n"),
            name +
                " was begun with line-echo-near-1 and 3 other runs, which the campaign file no longer has; name "
                "another folder\n" +
                name + " was begun with other options of line-echo-near-2 and 1 other run; name another folder\n" +
                name + " was begun with 2 trials, the campaign file has 1; name another folder");
  EXPECT_EQ(results_of(folder) + files::read_file(folder / "campaign.toml"), before);
}

/// The campaign of a robot "cart" whose file has this text.
Campaign run_cart(const fs::path& folder, const std::string& robot, const std::string& seeds = "1-2") {
  struct Cart final : experiment::fake::LineBuilder {
    std::string name() const override { return "cart"; }
  };
  experiment::Catalogue catalogue = experiment::fake::catalogue();
  catalogue.read_robot = [](std::string_view, const std::string&, const auto&) {
    return [] { return std::make_unique<Cart>(); };
  };
  return run_campaign(catalogue.with_robot(robot, "cart.toml", ""),
                      "format = 1\nscenario = \"cart\"\nlearners = [\"echo\"]\ntrials = 1\nseeds = \"" + seeds + "\"\n",
                      "c.toml", folder, {.threads = 1});
}

TEST(CampaignFolder, ARobotWhoseFileHasChangedIsRefusedAndNothingIsRecorded) {
  const fs::path folder = experiment::fake::test_folder() / "campaign";
  EXPECT_TRUE(run_cart(folder, "mass = 1").complete());
  const auto all = [&] { return results_of(folder) + files::read_file(folder / "campaign.toml"); };
  const std::string before = all();
  const std::string said = folder.string() +
                           " was begun with another robot cart: its file, or one that it names, has changed since; "
                           "name another folder";
  using experiment::fake::message_of;
  EXPECT_EQ(message_of<InvalidInput>([&] { run_cart(folder, "mass = 2"); }), said);
  EXPECT_EQ(message_of<InvalidInput>([&] { run_cart(folder, "mass = 2", "1-3"); }), said) << "with one run more";
  EXPECT_EQ(all(), before);
  EXPECT_FALSE(fs::exists(folder / "runs/cart-echo-near-3"));
  EXPECT_TRUE(run_cart(folder, "mass = 1", "1-3").complete()) << "the old robot goes on";
}

TEST(CampaignFolder, OtherFoldersAreRefused) {
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

}  // namespace
}  // namespace rehearse::campaign
