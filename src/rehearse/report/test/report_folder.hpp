#pragma once
// Folders of runs and campaigns to report on.

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
#include "rehearse/files/checksum.hpp"
#include "rehearse/report/report.hpp"

namespace rehearse::report {

namespace fs = std::filesystem;
using nlohmann::json;
using Lines = std::vector<std::string>;

inline void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string checksum_of(std::string_view bytes) { return fmt::format("{:016x}", files::checksum(bytes)); }

/// A folder of its own for each test, which runs and campaigns are written to.
class ReportFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / fmt::format("report-{}-{}", test->test_suite_name(), test->name());
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
    write(run / "identifiability.csv", "trial,warning\n2,m is not determined by these data\n");
    for (int trial : {1, 2})
      write(run / fmt::format("trajectories/trial-00{}.csv", trial),
            "time [s],x [m],true x [m],u [N],reward\n0,0,0,1,\n0.1,0.5,0.4,,1\n");
    write(run / "predictions/trial-002.csv", "time [s],particles,x mean [m]\n0,100,0\n0.1,100,\n");
    write(run / "motion/trial-002.json", R"({"format":1,"unit":"m","goal":null,"bodies":[],"frames":[[1.23456789]]})");
    write(run / "motion/prediction-002.json", R"({"format":1,"unit":"m","goal":null,"bodies":[],"frames":[[null]]})");
    write(run / "checkpoint", "rehearse-checkpoint 1 3 " + checksum_of("abc") + "\nabc");
    write(run / "done", "2 trials\n");
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
    json summary = {{"format", 1},          {"title", "t"},
                    {"scenario", "slider"}, {"trials", 2},
                    {"complete", true},     {"counts", {{"runs", 4}, {"done", 3}, {"failed", 1}, {"unfinished", 0}}}};
    for (const char* list : {"seeds", "learners", "priors", "variants", "missing", "skipped", "runs", "claims"})
      summary[list] = json::array();
    std::string rows = "run,scenario,learner,prior,variant,seed,trial,phi.m,phi.m.low,phi.m.high\n";
    for (int seed : {1, 2, 3}) {
      const std::string name = fmt::format("run-{}", seed);
      write_run(folder_ / "runs" / name, seed);
      summary["runs"].push_back(run_entry(name, seed, "done"));
      rows += fmt::format("{0},slider,gp-mi,light,,{1},1,,,\n{0},slider,gp-mi,light,,{1},2,{2},1,2\n", name, seed,
                          1 + 0.1 * seed);
    }
    summary["runs"].push_back(run_entry("run-4", 4, "failed"));
    summary["groups"] = {{{"learner", "gp-mi"}, {"prior", "light"}, {"variant", ""}, {"trials", json::array()}}};
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

}  // namespace rehearse::report
