#include "rehearse/report/report.hpp"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/files/checksum.hpp"
#include "rehearse/qd/archive_bytes.hpp"

namespace rehearse::report {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Lines = std::vector<std::string>;

void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

std::string read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string checksum_of(std::string_view bytes) { return fmt::format("{:016x}", files::checksum(bytes)); }

class ReportTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / fmt::format("report-{}", test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Two trials of a block that slides; trial 1 has no prediction.
  static void write_run(const fs::path& run, int seed = 1) {
    write(run / "spec.toml",
          fmt::format("format = 1\n[run]\nscenario = \"slider\"\nlearner = \"gp-mi\"\nprior = \"light\"\n"
                      "trials = 2\nseed = {}\n[scenario]\nplant.m = 1.5\nkind = \"a\"\n[learner]\nx = 2\n",
                      seed));
    write(run / "trials.csv",
          "trial,interaction_s,return,solved,predicted_return,rollouts,failed_rollouts,log_evidence,phi.m,phi.m.low,"
          "phi.m.high,phi.k\n"
          "1,2.5,0.123456789,0,,0,0,,,,,\n2,5,3,1,2.75,1234567,1,12.5,1.4,1.25,1.6,0.25\n");
    write(run / "timings.csv", fmt::format("trial,model_s,search_s,rollouts_per_s\n1,0.5,2,10\n2,1,{},10\n", 2 + seed));
    write(run / "errors.csv", "trial,horizon,compared,failed,rms x [m]\n2,1,50,0,0.01\n");
    write(run / "notes.csv", "trial,note\n2,\"a fit, failed\"\n");
    write(run / "identifiability.csv", "trial,warning\n2,m is not determined by these trials\n");
    for (int trial : {1, 2})
      write(run / fmt::format("trajectories/trial-00{}.csv", trial),
            "time [s],x [m],true x [m],u [N],reward\n0,0,0,1,\n0.1,0.5,0.4,,1\n");
    write(run / "predictions/trial-002.csv", "time [s],particles,x mean [m]\n0,100,0\n0.1,100,\n");
    write(run / "motion/trial-002.json", R"({"format":1,"unit":"m","goal":null,"bodies":[],"frames":[[1.23456789]]})");
    write(run / "motion/prediction-002.json", R"({"format":1,"unit":"m","goal":null,"bodies":[],"frames":[[null]]})");
    write(run / "checkpoint", "rehearse-checkpoint 1 3 " + checksum_of("abc") + "\nabc");
    write(run / "done", "2 trials\n");
  }

  /// Three elites of two descriptors in a grid, one of them tried.
  static void write_archive(const fs::path& run) {
    qd::Archive archive(qd::Niches(qd::Grid{{{-1, 1}, {0, 2}}, {4, 5}}), 1);
    for (const Vector& elite : {Vector{{-0.5, 0.1, 2}}, Vector{{0.123456, 1, 3.14159}}, Vector{{1, 2, -1}}})
      archive.add(archive.niches().find(elite.data()), elite(2), elite.data(), elite.data());
    write(run / "archive.bin", qd::to_bytes({archive, 3, 0, "test"}));
    write(run / "elites.csv",
          "reach [m],height [m],promised,expected,deviation\n"
          "-0.5,0.1,2,1.99999,0.1\n0.123456,1,3.14159,0.5,0.2\n1,2,-1,-1.5,0.3\n");
    write(run / "tried.csv", "trial,elite,promised,learned\n1,2,3.14159,1\n2,2,3.14159,0\n");
  }

  static ArchiveSpace archive_space(std::string_view bytes) {
    const qd::Archive archive = qd::from_bytes(bytes, "it is no usable archive").archive;
    const qd::Niches& niches = archive.niches();
    return {archive.size(), niches.size(), niches.bounds(), niches.bins()};
  }

  static json run_entry(const std::string& name, int seed, const std::string& state) {
    return {{"run", name},
            {"folder", "runs/" + name},
            {"learner", "gp-mi"},
            {"prior", "light"},
            {"variant", ""},
            {"seed", seed},
            {"state", state},
            {"trials", 2},
            {"first_success", 2},
            {"best_return", 3},
            {"reason", state == "failed" ? json("the plant failed") : json()}};
  }

  /// Four runs: three done, one failed.
  void write_campaign() const {
    json summary = {{"format", 1}, {"title", "t"}, {"skipped", json::array()}, {"runs", json::array()}};
    std::string rows = "run,scenario,learner,prior,variant,seed,trial,phi.m,phi.m.low,phi.m.high\n";
    for (int seed : {1, 2, 3}) {
      const std::string name = fmt::format("run-{}", seed);
      write_run(folder_ / "runs" / name, seed);
      summary["runs"].push_back(run_entry(name, seed, "done"));
      rows += fmt::format("{0},slider,gp-mi,light,,{1},1,,,\n{0},slider,gp-mi,light,,{1},2,{2},1,2\n", name, seed,
                          1 + 0.1 * seed);
    }
    summary["runs"].push_back(run_entry("run-4", 4, "failed"));
    summary["groups"] = {{{"learner", "gp-mi"}, {"prior", "light"}, {"variant", ""}}};
    write(folder_ / "summary.json", summary.dump());
    write(folder_ / "campaign.csv", rows);
  }

  Lines problems_of(const Report& report) const {
    Lines lines;
    for (const Problem& problem : report.problems) lines.push_back(problem.where + ": " + problem.what);
    return lines;
  }

  std::string error_of(const std::function<void()>& call) const {
    try {
      call();
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(ReportTest, ARunHasItsTablesAsColumns) {
  write_run(folder_);
  const Report report = read_folder(folder_);
  EXPECT_EQ(problems_of(report), Lines{});
  const json all = json::parse(report.json), &run = all["run"];
  EXPECT_EQ(all["name"], folder_.filename().string());
  EXPECT_EQ(run["learner"], "gp-mi");
  EXPECT_EQ(run["planned"], 2);
  EXPECT_EQ(run["done"], true);
  EXPECT_EQ(run["options"], json::parse(R"([["scenario.plant.m","1.5"],["scenario.kind","a"],["learner.x","2"]])"));
  EXPECT_EQ(run["trials"]["return"], json::parse("[0.123457, 3]"));
  EXPECT_EQ(run["trials"]["rollouts"], json::parse("[0, 1234567]"));
  EXPECT_EQ(run["trials"]["predicted_return"], json::parse("[null, 2.75]"));
  EXPECT_EQ(run["truth"], json::parse(R"({"m": 1.5})"));  // k is not the plant's
  EXPECT_EQ(run["notes"]["note"], json::parse(R"(["a fit, failed"])"));
  EXPECT_EQ(run["trials"]["phi.m.high"], json::parse("[null, 1.6]"));
  EXPECT_EQ(run["identifiability"]["warning"], json::parse(R"(["m is not determined by these trials"])"));
  ASSERT_EQ(run["episodes"].size(), 2u);
  EXPECT_EQ(run["episodes"][0]["trajectory"]["true x [m]"], json::parse("[0, 0.4]"));
  EXPECT_TRUE(run["episodes"][0]["prediction"].is_null());
  EXPECT_TRUE(run["episodes"][0]["motion"].is_null());
  EXPECT_EQ(run["episodes"][1]["prediction"]["x mean [m]"], json::parse("[0, null]"));
  EXPECT_EQ(run["episodes"][1]["motion"]["frames"], json::parse("[[1.23457]]"));
  EXPECT_EQ(run["episodes"][1]["motion"]["predicted"], json::parse("[[null]]"));
}

TEST_F(ReportTest, ARunOfAnOlderVersionHasNoIdentifiabilityWarnings) {
  write_run(folder_);
  fs::remove(folder_ / "identifiability.csv");
  const Report report = read_folder(folder_);
  EXPECT_EQ(problems_of(report), Lines{});
  EXPECT_FALSE(json::parse(report.json)["run"].contains("identifiability"));
}

TEST_F(ReportTest, AnArchiveHasWhatItPromisesAndWhatIsExpectedOfIt) {
  write_run(folder_);
  EXPECT_FALSE(json::parse(read_folder(folder_, archive_space).json)["run"].contains("archive"));
  write_archive(folder_);
  const Report report = read_folder(folder_, archive_space);
  EXPECT_EQ(problems_of(report), Lines{});
  EXPECT_EQ(json::parse(report.json)["run"]["archive"], json::parse(R"({
    "descriptors": [{"name": "reach [m]", "values": [-0.5, 0.1235, 1]}, {"name": "height [m]", "values": [0.1, 1, 2]}],
    "promised": [2, 3.142, -1], "expected": [2, 0.5, -1.5],
    "space": {"niches": 20, "bounds": [[-1, 1], [0, 2]], "bins": [4, 5]},
    "tried": {"trial": [1, 2], "elite": [2, 2], "promised": [3.14159, 3.14159], "learned": [1, 0]}})"));
  EXPECT_FALSE(json::parse(read_trial(folder_, 1).json)["replay"].contains("archive"));
}

TEST_F(ReportTest, ADamagedArchiveIsNamedAndTheTablesAreShown) {
  write_run(folder_);
  write_archive(folder_);
  std::string bytes = read_bytes(folder_ / "archive.bin");
  bytes[bytes.size() - 3] ^= 1;
  write(folder_ / "archive.bin", bytes);
  const std::string damage = "archive.bin: it is no usable archive: damaged: the files::checksum does not fit";
  Report report = read_folder(folder_, archive_space);
  EXPECT_EQ(problems_of(report), Lines{damage});
  const json archive = json::parse(report.json)["run"]["archive"];
  EXPECT_TRUE(archive["space"].is_null());
  EXPECT_EQ(archive["promised"], json::parse("[2, 3.142, -1]"));

  fs::remove(folder_ / "elites.csv");
  report = read_folder(folder_, archive_space);
  EXPECT_EQ(problems_of(report), (Lines{damage, "elites.csv: it is not there"}));
  EXPECT_FALSE(json::parse(report.json)["run"].contains("archive"));
  fs::remove(folder_ / "tried.csv");  // a run of an older version, or one without a trial
  EXPECT_EQ(problems_of(read_folder(folder_, archive_space)), Lines{damage});
  write(folder_ / "archive.bin", "foreign");
  EXPECT_EQ(problems_of(read_folder(folder_, archive_space)),
            Lines{"archive.bin: it is no usable archive: not an archive of Rehearse"});
}

TEST_F(ReportTest, ThatTablesOfAnArchiveContradictThemselvesIsNamed) {
  write_run(folder_);
  write_archive(folder_);
  const auto problems_with = [&](const char* file, const std::string& text) {
    write_archive(folder_);
    if (text.empty())
      fs::remove(folder_ / file);
    else
      write(folder_ / file, text);
    return problems_of(read_folder(folder_, archive_space));
  };
  const std::string header = "reach [m],height [m],promised,expected,deviation\n";
  EXPECT_EQ(problems_with("elites.csv", "promised,expected\n1,2\n"),
            Lines{"elites.csv: there are no descriptors before a column promised"});
  EXPECT_EQ(problems_with("elites.csv", header), Lines{"elites.csv: it has no elites"});
  EXPECT_EQ(problems_with("elites.csv", header + "0,0,1,,1\n"), Lines{"elites.csv: row 2 has no finite expected"});
  EXPECT_EQ(problems_with("elites.csv", header + "0,0,1,1,1\n0,0,1"), Lines{"elites.csv: row 3 is cut short"});
  EXPECT_EQ(problems_with("elites.csv", header + "0,0,1,1,1\n0,0,1,1,1\n"),
            Lines({"archive.bin: it has 3 elites of 2 descriptors, elites.csv 2 of 2"}));
  EXPECT_EQ(problems_with("archive.bin", ""), Lines{"archive.bin: it is not there"});
  EXPECT_EQ(problems_with("tried.csv", ""), Lines{"tried.csv: it is not there"});
  EXPECT_EQ(problems_with("tried.csv", "trial,elite,promised,learned\n1,4,1,1\n"),
            Lines{"tried.csv: elite 4 is not among the 3 of elites.csv"});
}

// The start is known exactly; at 0.1 s x is 0.5 and at 0.2 s 1.5 of the samples' deviations apart, y less.
TEST_F(ReportTest, TheGapOfTwoPredictionsIsThatOfTheirMeansAndSpreads) {
  write_run(folder_);
  const auto gap = [&](const std::string& last) {
    write(folder_ / "predictions/trial-002.csv",
          "time [s],particles,x mean [m],y mean,x std [m],y std,x moment mean [m],y moment mean,x moment std [m],"
          "y moment std,reward mean,reward std,reward moment mean,reward moment std\n"
          "0,100,1,5,0,1,1,5,0,1,,,,\n0.1,100,1.5,5,0.2,1,1.4,5,0.4,1,0.5,0.1,0.25,0.1\n" +
              last);
    const Report report = read_folder(folder_);
    EXPECT_EQ(problems_of(report), Lines{});
    return json::parse(report.json)["run"]["episodes"][1]["gap"];
  };
  EXPECT_EQ(gap("0.2,100,2,5,0.2,1,2.3,6,0.8,1,0.75,0.1,0.5,0.1\n"),
            json::parse(R"({"apart":1.5,"state":"x","time_s":0.2,"spread":1.51572,
                            "sampled_return":1.25,"moment_return":0.75})"));  // spread: 8^(1/5)
  const json cut = gap("0.2,100,2,5,0.2,1,,,,,0.75,0.1,,\n");
  EXPECT_EQ(cut["apart"], 0.5);
  EXPECT_TRUE(cut["moment_return"].is_null());
}

TEST_F(ReportTest, APredictionOfSamplesAloneHasNoGap) {
  write_run(folder_);
  EXPECT_TRUE(json::parse(read_folder(folder_).json)["run"]["episodes"][1]["gap"].is_null());
  write(folder_ / "predictions/trial-002.csv", "time [s],x mean [m],x moment mean [m]\n0,1,1\n");
  const Report damaged = read_folder(folder_);
  ASSERT_EQ(damaged.problems.size(), 1U);
  EXPECT_EQ(damaged.problems[0].where, "predictions/trial-002.csv");
}

TEST_F(ReportTest, AReplayHasOneEpisode) {
  write_run(folder_);
  const json all = json::parse(read_trial(folder_, 2).json);
  ASSERT_EQ(all["replay"]["episodes"].size(), 1u);
  EXPECT_EQ(all["replay"]["episodes"][0]["trial"], 2);
  EXPECT_TRUE(error_of([&] { read_trial(folder_, 3); }).starts_with("trial 3 is not in "));
  write(folder_ / "other/summary.json", "{}");
  EXPECT_NE(error_of([&] { read_trial(folder_ / "other", 1); }).find("is not a run folder"), std::string::npos);
}

TEST_F(ReportTest, AMotionInSpaceIsCarriedWhole) {
  write_run(folder_);
  json motion = json::parse(R"({"format":1,"dimensions":3,"unit":"m","floor":0,
    "bodies":[{"name":"leg","shape":"capsule","radius":0.01,"length":0.1}],"frames":[[1,2,3,1,0,0,0]]})");
  write(folder_ / "motion/trial-002.json", motion.dump());
  motion["predicted"] = json::parse("[[4,5,6,0,1,0,null]]");
  write(folder_ / "motion/prediction-002.json", json{{"frames", motion["predicted"]}}.dump());
  EXPECT_EQ(json::parse(read_trial(folder_, 2).json)["replay"]["episodes"][0]["motion"], motion);
}

TEST_F(ReportTest, WhatIsNoNumberOrNoMotionIsNamed) {
  write_run(folder_);
  write(folder_ / "trials.csv", "trial,interaction_s,return\n1,2.5,0.1\n2,5,7.0x3\n");
  const auto motion_problem = [&](const char* trial, const char* prediction) {
    write(folder_ / "motion/trial-002.json", trial);
    write(folder_ / "motion/prediction-002.json", prediction);
    const Report report = read_folder(folder_, {});
    EXPECT_EQ(json::parse(report.json)["run"]["trials"]["return"], json::parse("[0.1, null]"));
    EXPECT_EQ(report.problems.size(), 2u);
    EXPECT_EQ(report.problems[0].where, "trials.csv");
    EXPECT_EQ(report.problems[0].what, "row 3: return = 7.0x3, must be a number");
    return report.problems.back().where + ": " + report.problems.back().what;
  };
  const char* whole =
      R"({"format":1,"unit":"m","goal":null,"bodies":[{"name":"cart","width":1}],"frames":[[1,2,3,4]]})";
  EXPECT_EQ(motion_problem(R"({"frames":"no","bodies":3,"unit":{}})", whole),
            "motion/trial-002.json: its bodies cannot be drawn");
  EXPECT_EQ(motion_problem(R"({"bodies":[{"name":"cart","width":1}],"frames":[[1,2,3]]})", whole),
            "motion/trial-002.json: it has no frames of 4 numbers each");
  EXPECT_EQ(motion_problem("[]", whole), "motion/trial-002.json: it is no motion");
  EXPECT_EQ(motion_problem(whole, R"({"frames":[["x",2,3,4]]})"),
            "motion/prediction-002.json: it has no frames of 4 numbers each");
}

TEST_F(ReportTest, HostileFilesAreProblems) {
  write_run(folder_);
  const auto problem_with = [&](const std::string& text) {
    write(folder_ / "motion/trial-002.json", text);
    const Lines all = problems_of(read_folder(folder_));
    return all.size() == 1 ? all.front() : fmt::format("{} problems", all.size());
  };
  const std::string where = "motion/trial-002.json: ";
  const std::string deep = where + "it is nested deeper than 64 levels";
  EXPECT_EQ(problem_with(std::string(100000, '[')), deep);
  EXPECT_EQ(problem_with(std::string(100000, '[') + std::string(100000, ']')), deep);
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
  EXPECT_EQ(problem_with(objects), deep);
  EXPECT_EQ(problem_with(R"({"bodies":[],"frames":[[1e999]]})"), where + "it has a number that is too large");
}

TEST_F(ReportTest, WaitsForNoFifoAndFollowsNoLink) {
  write_run(folder_);
  for (const char* file : {"motion/trial-002.json", "trajectories/trial-001.csv", "timings.csv", "checkpoint"}) {
    fs::remove(folder_ / file);
    ASSERT_EQ(::mkfifo((folder_ / file).c_str(), 0600), 0);
  }
  fs::remove(folder_ / "notes.csv");
  fs::create_symlink("errors.csv", folder_ / "notes.csv");
  const std::string no_file = ": it is no regular file";
  EXPECT_EQ(problems_of(read_folder(folder_)),
            (Lines{"timings.csv" + no_file, "notes.csv: it is a link", "checkpoint" + no_file,
                   "trajectories/trial-001.csv" + no_file, "motion/trial-002.json" + no_file}));
  fs::remove(folder_ / "spec.toml");
  ASSERT_EQ(::mkfifo((folder_ / "spec.toml").c_str(), 0600), 0);
  EXPECT_EQ(error_of([&] { read_folder(folder_); }), (folder_ / "spec.toml").string() + no_file);
}

TEST_F(ReportTest, ACampaignWaitsForNoFifo) {
  write_campaign();
  const fs::path file = folder_ / "runs/run-1/trajectories/trial-001.csv";
  fs::remove(file);
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  const Lines problems = problems_of(read_folder(folder_));
  EXPECT_NE(std::find(problems.begin(), problems.end(), "runs/run-1/trajectories/trial-001.csv: it is no regular file"),
            problems.end());
}

TEST_F(ReportTest, ADamagedRunIsReportedWithoutWhatIsDamaged) {
  write_run(folder_);
  write(folder_ / "trials.csv", "trial,interaction_s,return\n1,2.5,0.1\n2,5");
  write(folder_ / "trajectories/trial-001.csv", "time [s],x [m],true x [m],u [N],reward\n0,0,0");
  write(folder_ / "motion/trial-002.json", "{\"format\":1,");
  write(folder_ / "checkpoint", "rehearse-checkpoint 1 3 0000000000000000\nab");
  fs::remove(folder_ / "errors.csv");
  const Report report = read_folder(folder_);
  EXPECT_EQ(
      problems_of(report),
      (Lines{"trials.csv: row 3 is cut short", "errors.csv: it is not there", "checkpoint: it is truncated or damaged",
             "trajectories/trial-001.csv: row 2 is cut short", "motion/trial-002.json: it is truncated or no JSON"}));
  const json all = json::parse(report.json);
  EXPECT_EQ(all["problems"].size(), 5u);
  EXPECT_FALSE(all["run"].contains("trials"));
  EXPECT_TRUE(all["run"]["episodes"][0]["trajectory"].is_null());
  EXPECT_TRUE(all["run"]["episodes"][1]["trajectory"].is_object());
}

TEST_F(ReportTest, ACampaignHasParametersAndTimes) {
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

TEST_F(ReportTest, ACampaignNamesWhatIsWrongInItsFolder) {
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
             "runs/run-2/checkpoint: format 7 is that of another version of Rehearse",
             "runs/run-3: it is not there, or no folder", "runs/run-4: failed: the plant failed",
             "runs/notes.txt: it is no run of this campaign"}));

  write(folder_ / "campaign.csv", "run,learner");
  const Report report = read_folder(folder_);
  EXPECT_EQ(report.problems.back().where, "campaign.csv");
  EXPECT_EQ(json::parse(report.json)["campaign"]["parameters"], json::array());
}

TEST_F(ReportTest, RefusesWhatIsNoFolderOfRehearse) {
  const auto error = [&] { return error_of([&] { read_folder(folder_); }); };
  EXPECT_NE(error().find("is neither a run folder (no spec.toml) nor a campaign (no summary.json)"), std::string::npos);
  write(folder_ / "campaign.toml", "");
  EXPECT_NE(error().find("is a campaign without results yet"), std::string::npos);
  write(folder_ / "summary.json", R"({"format": 2})");
  EXPECT_TRUE(error().ends_with("summary.json: format 2 is that of another version of Rehearse, this one reads 1"))
      << error();
  write(folder_ / "summary.json", R"({"format": 1})");
  EXPECT_TRUE(error().ends_with("summary.json: it lacks what docs/campaigns.md promises")) << error();
  write(folder_ / "summary.json", "[]");
  EXPECT_TRUE(error().ends_with("summary.json: it is no summary of a campaign")) << error();
  write(folder_ / "spec.toml", "format = 3\n[run]\n");
  EXPECT_TRUE(error().ends_with("spec.toml: format 3 is that of another version of Rehearse, this one reads 1"))
      << error();
  write(folder_ / "spec.toml", "format = \n");
  EXPECT_NE(error().find("spec.toml: line 1: "), std::string::npos) << error();
  EXPECT_NE(error_of([&] { read_folder(folder_ / "spec.toml"); }).find("is not a folder"), std::string::npos);
}

TEST(Html, HoldsTheDataAndNothingThatEndsIt) {
  const Report report{.json = R"({"name":"</script><b>"})"};
  EXPECT_EQ(to_html(report, "<script>REHEARSE_REPORT_DATA</script>"),
            R"(<script>{"name":"\u003c/script>\u003cb>"}</script>)");
  EXPECT_THROW(to_html(report, "<script></script>"), InvalidInput);
  EXPECT_THROW(to_html(report, "REHEARSE_REPORT_DATA REHEARSE_REPORT_DATA"), InvalidInput);
}

}  // namespace
}  // namespace rehearse::report
