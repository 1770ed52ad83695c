#include "rehearse/report/prediction_gap.hpp"

#include <gtest/gtest.h>

#include "report_folder.hpp"

namespace rehearse::report {
namespace {

class PredictionGap : public ReportFolder {};

// The start is known exactly; at 0.1 s x is 0.5 and at 0.2 s 1.5 of the samples' deviations apart, y less.
TEST_F(PredictionGap, TheGapOfTwoPredictionsIsThatOfTheirMeansAndSpreads) {
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

TEST_F(PredictionGap, APredictionOfSamplesAloneHasNoGap) {
  write_run(folder_);
  EXPECT_TRUE(json::parse(read_folder(folder_).json)["run"]["episodes"][1]["gap"].is_null());
  write(folder_ / "predictions/trial-002.csv", "time [s],x mean [m],x moment mean [m]\n0,1,1\n");
  const Report damaged = read_folder(folder_);
  ASSERT_EQ(damaged.problems.size(), 1U);
  EXPECT_EQ(damaged.problems[0].where, "predictions/trial-002.csv");
}

}  // namespace
}  // namespace rehearse::report
