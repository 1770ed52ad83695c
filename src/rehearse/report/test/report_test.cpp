#include "rehearse/report/report.hpp"

#include <gtest/gtest.h>

#include "report_folder.hpp"

namespace rehearse::report {
namespace {

class ReportTest : public ReportFolder {};

TEST_F(ReportTest, AReplayHasOneEpisode) {
  write_run(folder_);
  const json all = json::parse(read_trial(folder_, 2).json);
  ASSERT_EQ(all["replay"]["episodes"].size(), 1u);
  EXPECT_EQ(all["replay"]["episodes"][0]["trial"], 2);
  EXPECT_TRUE(error_of([&] { read_trial(folder_, 3); }).starts_with("trial 3 is not in "));
  write(folder_ / "other/summary.json", "{}");
  EXPECT_NE(error_of([&] { read_trial(folder_ / "other", 1); }).find("is not a run folder"), std::string::npos);
}

TEST_F(ReportTest, RefusesWhatIsNoFolderOfRehearse) {
  const auto error = [&] { return error_of([&] { read_folder(folder_); }); };
  EXPECT_NE(error().find("is neither a run folder (no spec.toml) nor a campaign (no summary.json)"), std::string::npos);
  write(folder_ / "logs/identify.html", "");
  EXPECT_TRUE(error_of([&] {
                read_folder(folder_ / "logs");
              }).ends_with("its page is " + (folder_ / "logs/identify.html").string()));
  write(folder_ / "campaign.toml", "");
  EXPECT_NE(error().find("is a campaign without results yet"), std::string::npos);
  write(folder_ / "summary.json", R"({"format": 2})");
  EXPECT_TRUE(error().ends_with("summary.json: format 2 is that of another version of Rehearse, this one reads 1"))
      << error();
  write(folder_ / "summary.json", R"({"format": 1})");
  EXPECT_TRUE(error().ends_with("summary.json: claims must be a list")) << error();
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
