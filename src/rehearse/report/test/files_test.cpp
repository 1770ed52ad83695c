#include "rehearse/report/files.hpp"

#include <gtest/gtest.h>

#include "report_folder.hpp"

namespace rehearse::report {
namespace {

class Files : public ReportFolder {};

TEST(Rounded, KeepsWholeNumbersAndSoManyDigitsOfOthers) {
  EXPECT_EQ(rounded(1234567.0), 1234567);
  EXPECT_EQ(rounded(0.123456789), 0.123457);
  EXPECT_EQ(rounded(12345.678, 4), 12350);
  EXPECT_TRUE(rounded(kInf).is_null());
  EXPECT_EQ(rounded(Json::parse(R"({"a": [0.123456789, "0.123456789"]})")),
            Json::parse(R"({"a": [0.123457, "0.123456789"]})"));
}

TEST(Columns, HaveTextsWhereTheTableDoes) {
  const files::Table table{{"note", "limit"}, {{"1", "2"}}};
  Problems problems;
  EXPECT_EQ(columns(table, "trajectory.csv", problems), Json::parse(R"({"note": [1], "limit": [2]})"))
      << "states may have such names";
  EXPECT_EQ(columns(table, "notes.csv", problems, "note"), Json::parse(R"({"note": ["1"], "limit": [2]})"));
}

TEST_F(Files, WhatIsNoNumberOrNoMotionIsNamed) {
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

TEST_F(Files, HostileFilesAreProblems) {
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

}  // namespace
}  // namespace rehearse::report
