#include "rehearse/report/campaign_files.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "report_folder.hpp"

namespace rehearse::report {
namespace {

class CampaignFiles : public ReportFolder {};

TEST_F(CampaignFiles, ACampaignWaitsForNoFifo) {
  write_campaign();
  const fs::path file = folder_ / "runs/run-1/trajectories/trial-001.csv";
  fs::remove(file);
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  const Lines problems = problems_of(read_folder(folder_));
  EXPECT_NE(std::find(problems.begin(), problems.end(), "runs/run-1/trajectories/trial-001.csv: it is no regular file"),
            problems.end());
}

TEST_F(CampaignFiles, ACampaignHasParametersAndTimes) {
  write_campaign();
  const json all = json::parse(read_folder(folder_).json), &campaign = all["campaign"];
  EXPECT_EQ(campaign["summary"]["title"], "t");
  ASSERT_EQ(campaign["parameters"].size(), 1u);
  EXPECT_EQ(campaign["parameters"][0],
            json::parse(R"({"learner":"gp-mi","prior":"light","variant":"","parameter":"m","truth":1.5,
    "trials":[{"trial":2,"runs":3,"quartile_1":1.15,"median":1.2,"quartile_3":1.25}]})"));
  ASSERT_EQ(campaign["times"].size(), 2u);
  EXPECT_EQ(campaign["times"][1]["part"], "search_s");
  EXPECT_EQ(campaign["times"][1]["trials"][1],
            json::parse(R"({"trial":2,"runs":3,"quartile_1":3.5,"median":4,"quartile_3":4.5})"));
}

TEST_F(CampaignFiles, ATruthIsThatOfAllRunsOrNone) {
  write_campaign();
  const auto truth = [&] { return json::parse(read_folder(folder_).json)["campaign"]["parameters"][0]["truth"]; };
  EXPECT_EQ(truth(), 1.5);
  const std::string spec = "format = 1\n[run]\nscenario = \"slider\"\n[scenario]\n";
  write(folder_ / "runs/run-2/spec.toml", spec + "plant.m = 1.4\n");
  EXPECT_EQ(truth(), nullptr) << "the campaign draws it for each seed";
  write(folder_ / "runs/run-2/spec.toml", spec);
  EXPECT_EQ(truth(), nullptr) << "a run does not say it";
  write(folder_ / "runs/run-2/spec.toml", "format = 9\n");
  EXPECT_EQ(truth(), 1.5) << "an unreadable run says nothing";
}

TEST_F(CampaignFiles, ASummaryNeedsWhatThePageShows) {
  write_campaign();
  std::ifstream file(folder_ / "summary.json");
  const json whole = json::parse(file);
  json bad = whole;
  bad["claims"] = nullptr;
  bad.erase("counts");
  bad["groups"][0]["trials"] = nullptr;
  bad["runs"][1]["reason"] = 5;
  write(folder_ / "summary.json", bad.dump());
  const std::string error = error_of([&] { read_folder(folder_); }), where = (folder_ / "summary.json").string();
  EXPECT_EQ(error, where + ": counts must be an object\n" + where + ": runs[1].reason must be a text\n" + where +
                       ": groups[0].trials must be a list\n" + where + ": claims must be a list");
  bad = whole;
  bad["runs"][3].erase("reason");
  write(folder_ / "summary.json", bad.dump());
  EXPECT_EQ(problems_of(read_folder(folder_)), Lines{"runs/run-4: failed"});
}

TEST_F(CampaignFiles, TrialsAreAsManyAsARunCanHave) {
  write_campaign();
  std::ifstream file(folder_ / "summary.json");
  json summary = json::parse(file);
  for (const double wrong : {1e300, -1.0, 1.5}) {
    summary["runs"][0]["trials"] = wrong;
    write(folder_ / "summary.json", summary.dump());
    EXPECT_NE(error_of([&] { read_folder(folder_); }).find("must be a whole number in 0 to"), std::string::npos);
  }
  summary["runs"][0]["trials"] = 999999;
  write(folder_ / "summary.json", summary.dump());
  EXPECT_LT(problems_of(read_folder(folder_)).size(), 10U);
}

TEST_F(CampaignFiles, ATableWithoutItsColumnsIsNamed) {
  write_campaign();
  write(folder_ / "campaign.csv", "run,trial,phi.m\nrun-1,1,2\n");
  EXPECT_EQ(problems_of(read_folder(folder_)),
            (Lines{"runs/run-4: failed: the plant failed", "campaign.csv: there is no column learner"}));
  write(folder_ / "campaign.csv", "learner,prior,variant,trial,phi.m\ngp-mi,light,,1e300,2\n");
  EXPECT_EQ(problems_of(read_folder(folder_)).back(),
            "campaign.csv: trial = 1e+300, must be a whole number in 0 to 1000000");
}

TEST_F(CampaignFiles, ACampaignNamesWhatIsWrongInItsFolder) {
  write_campaign();
  EXPECT_EQ(problems_of(read_folder(folder_)), Lines{"runs/run-4: failed: the plant failed"});

  write(folder_ / "runs/run-1/trials.csv", "trial,return\n1,2\n");
  write(folder_ / "runs/run-1/predictions/trial-002.csv", "time [s],part");
  write(folder_ / "runs/run-2/spec.toml", "format = 2\n[run]\n");
  write(folder_ / "runs/run-2/checkpoint", "rehearse-checkpoint 7 3 0\nabc");
  fs::remove_all(folder_ / "runs/run-3");
  write(folder_ / "runs/notes.txt", "mine");
  write(folder_ / "runs/.being-made/spec.toml", "");
  EXPECT_EQ(
      problems_of(read_folder(folder_)),
      (Lines{"runs/run-1/trials.csv: it has 1 of 2 trials", "runs/run-1/predictions/trial-002.csv: it is cut short",
             "runs/run-2/spec.toml: format 2 is that of another version of Rehearse, this one reads 1",
             "runs/run-2/checkpoint: the checkpoint has format 7, of another version of Rehearse (this one reads 1)",
             "runs/run-3: it is not there, or no folder", "runs/run-4: failed: the plant failed",
             "runs/notes.txt: it is no run of this campaign"}));

  write(folder_ / "campaign.csv", "run,learner");
  const Report report = read_folder(folder_);
  EXPECT_EQ(report.problems.back().where, "campaign.csv");
  EXPECT_EQ(json::parse(report.json)["campaign"]["parameters"], json::array());
}

}  // namespace
}  // namespace rehearse::report
