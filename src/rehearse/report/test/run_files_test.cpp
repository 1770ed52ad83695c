#include "rehearse/report/run_files.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "report_folder.hpp"

namespace rehearse::report {
namespace {

class RunFiles : public ReportFolder {};

TEST_F(RunFiles, TheTruthOfAParameterIsThatOfThePlantWhicheverPriorItIsOf) {
  write_run(folder_);
  const RunSpec spec = read_spec(folder_);
  EXPECT_EQ(spec.learner, "gp-mi");
  EXPECT_EQ(spec.trials, 2);
  EXPECT_EQ(spec.truth("m"), 1.5);
  EXPECT_EQ(spec.truth("m@light"), 1.5);
  EXPECT_EQ(spec.truth("k"), std::nullopt);
  EXPECT_EQ(parameter_names(read_table(folder_ / "trials.csv")), (Lines{"m", "k"}));
}

TEST_F(RunFiles, ARunHasItsTablesAsColumns) {
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
  EXPECT_EQ(run["identifiability"]["warning"], json::parse(R"(["m is not determined by these data"])"));
  ASSERT_EQ(run["episodes"].size(), 2u);
  EXPECT_EQ(run["episodes"][0]["trajectory"]["true x [m]"], json::parse("[0, 0.4]"));
  EXPECT_TRUE(run["episodes"][0]["prediction"].is_null());
  EXPECT_TRUE(run["episodes"][0]["motion"].is_null());
  EXPECT_EQ(run["episodes"][1]["prediction"]["x mean [m]"], json::parse("[0, null]"));
  EXPECT_EQ(run["episodes"][1]["motion"]["frames"], json::parse("[[1.23457]]"));
  EXPECT_EQ(run["episodes"][1]["motion"]["predicted"], json::parse("[[null]]"));
}

TEST_F(RunFiles, ARunThatFailedSaysWhy) {
  write_run(folder_);
  write(folder_ / "failed", "trial 3: the plant failed: no answer\n");
  EXPECT_EQ(problems_of(read_folder(folder_)), Lines{"failed: trial 3: the plant failed: no answer"});
}

TEST_F(RunFiles, WhatTheRobotHasToDoIsOfThoseWhoKnowIt) {
  write_run(folder_);
  const Report report = read_folder(folder_, {.archive = {}, .robot = [](const std::string& name) {
                                                return RobotFacts{name + "!", {{"m", "kg"}}};
                                              }});
  const json run = json::parse(report.json)["run"];
  EXPECT_EQ(run["task"], run["scenario"].get<std::string>() + "!");
  EXPECT_EQ(run["units"], json::parse("{\"m\": \"kg\"}"));
  EXPECT_FALSE(json::parse(read_folder(folder_).json)["run"].contains("task"));
}

TEST_F(RunFiles, LimitsAreThereWhereTheTaskHasThem) {
  write_run(folder_);
  EXPECT_FALSE(json::parse(read_folder(folder_).json)["run"].contains("limits"));
  write(folder_ / "limits.csv",
        "trial,limit,allowed_risk,predicted_risk,low,high,broken\n1,track,0.05,,,,1\n2,track,0.05,0.01,0,0.03,0\n");
  const Report report = read_folder(folder_);
  EXPECT_EQ(problems_of(report), Lines{});
  const json limits = json::parse(report.json)["run"]["limits"];
  EXPECT_EQ(limits["names"], json::parse(R"(["track", "track"])"));
  EXPECT_EQ(limits["numbers"]["predicted_risk"], json::parse("[null, 0.01]"));
  EXPECT_EQ(limits["numbers"]["broken"], json::parse("[1, 0]"));
  EXPECT_FALSE(limits["numbers"].contains("limit"));
}

TEST_F(RunFiles, LogsThatWereToldBeforeTheFirstTrialAreKnown) {
  write_run(folder_);
  EXPECT_FALSE(json::parse(read_folder(folder_).json)["run"].contains("logs"));
  write(folder_ / "logs.csv", "log\n");
  const Report report = read_folder(folder_);
  EXPECT_EQ(problems_of(report), Lines{});
  EXPECT_EQ(json::parse(report.json)["run"]["logs"], true);
}

TEST_F(RunFiles, ARunOfAnOlderVersionHasNoIdentifiabilityWarnings) {
  write_run(folder_);
  fs::remove(folder_ / "identifiability.csv");
  const Report report = read_folder(folder_);
  EXPECT_EQ(problems_of(report), Lines{});
  EXPECT_FALSE(json::parse(report.json)["run"].contains("identifiability"));
}

TEST_F(RunFiles, AMotionInSpaceIsCarriedWhole) {
  write_run(folder_);
  json motion = json::parse(R"({"format":1,"dimensions":3,"unit":"m","floor":0,
    "bodies":[{"name":"leg","shape":"capsule","radius":0.01,"length":0.1}],"frames":[[1,2,3,1,0,0,0]]})");
  write(folder_ / "motion/trial-002.json", motion.dump());
  motion["predicted"] = json::parse("[[4,5,6,0,1,0,null]]");
  write(folder_ / "motion/prediction-002.json", json{{"frames", motion["predicted"]}}.dump());
  EXPECT_EQ(json::parse(read_trial(folder_, 2).json)["replay"]["episodes"][0]["motion"], motion);
}

TEST_F(RunFiles, WaitsForNoFifoAndFollowsNoLink) {
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

TEST_F(RunFiles, ADamagedRunIsReportedWithoutWhatIsDamaged) {
  write_run(folder_);
  write(folder_ / "trials.csv", "trial,interaction_s,return\n1,2.5,0.1\n2,5");
  write(folder_ / "trajectories/trial-001.csv", "time [s],x [m],true x [m],u [N],reward\n0,0,0");
  write(folder_ / "motion/trial-002.json", "{\"format\":1,");
  write(folder_ / "checkpoint", "rehearse-checkpoint 1 3 0000000000000000\nab");
  fs::remove(folder_ / "errors.csv");
  const Report report = read_folder(folder_);
  EXPECT_EQ(problems_of(report), (Lines{"trials.csv: row 3 is cut short", "errors.csv: it is not there",
                                        "checkpoint: the checkpoint is truncated or damaged",
                                        "trajectories/trial-001.csv: row 2 is cut short",
                                        "motion/trial-002.json: it is truncated or no JSON"}));
  const json all = json::parse(report.json);
  EXPECT_EQ(all["problems"].size(), 5u);
  EXPECT_FALSE(all["run"].contains("trials"));
  EXPECT_TRUE(all["run"]["episodes"][0]["trajectory"].is_null());
  EXPECT_TRUE(all["run"]["episodes"][1]["trajectory"].is_object());
}

}  // namespace
}  // namespace rehearse::report
