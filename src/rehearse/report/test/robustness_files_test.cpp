#include "rehearse/report/robustness_files.hpp"

#include "report_folder.hpp"

namespace rehearse::report {
namespace {

class RobustnessFiles : public ReportFolder {};

TEST_F(RobustnessFiles, AreColumnsOfEachParameter) {
  write(folder_ / "robustness.csv",
        "trial,settings,parameter,factor,solved\n2,noise=0.1,m,0.75,0.5\n2,noise=0.1,m,1,1\n2,noise=0.1,l,0.75,\n");
  Problems problems;
  const Json all = robustness_json(folder_, problems);
  EXPECT_EQ(all.dump(), R"({"settings":"noise=0.1","parameters":[)"
                        R"({"parameter":"m","columns":{"trial":[2,2],"factor":[0.75,1],"solved":[0.5,1]}},)"
                        R"({"parameter":"l","columns":{"trial":[2],"factor":[0.75],"solved":[null]}}]})");
  EXPECT_TRUE(problems.list().empty());
}

TEST_F(RobustnessFiles, OfOlderVersionsDoNotSayWhatWasSet) {
  write(folder_ / "robustness.csv", "parameter,factor\nm,1\n");
  Problems problems;
  EXPECT_EQ(robustness_json(folder_, problems).dump(),
            R"({"settings":"","parameters":[{"parameter":"m","columns":{"factor":[1]}}]})");
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
