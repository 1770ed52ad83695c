#include "rehearse/report/robustness_files.hpp"

#include "report_folder.hpp"

namespace rehearse::report {
namespace {

class RobustnessFiles : public ReportFolder {};

TEST_F(RobustnessFiles, AreColumnsOfEachParameter) {
  write(folder_ / "robustness.csv", "parameter,factor,solved\nm,0.75,0.5\nm,1,1\nl,0.75,\n");
  Problems problems;
  const Json all = robustness_json(folder_, problems);
  EXPECT_EQ(all.dump(), R"([{"parameter":"m","columns":{"factor":[0.75,1],"solved":[0.5,1]}},)"
                        R"({"parameter":"l","columns":{"factor":[0.75],"solved":[null]}}])");
  EXPECT_TRUE(problems.list().empty());
}

TEST_F(RobustnessFiles, MayBeMissingOrDamaged) {
  Problems problems;
  EXPECT_TRUE(robustness_json(folder_, problems).is_null());
  EXPECT_TRUE(problems.list().empty());
  write(folder_ / "robustness.csv", "name,factor\nm,1\n");
  EXPECT_TRUE(robustness_json(folder_, problems).is_null());
  write(folder_ / "robustness.csv", "parameter,factor\nm,0.7");
  EXPECT_TRUE(robustness_json(folder_, problems).is_null());
  EXPECT_EQ(problems.list().size(), 2u);
}

}  // namespace
}  // namespace rehearse::report
