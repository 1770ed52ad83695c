// The status line of long work whose output goes to a file.
#include "apps/cli/status_line.hpp"

#include <thread>

#include <gtest/gtest.h>

namespace rehearse::apps {
namespace {

TEST(StatusLine, SaysInAFileHowFarItIsWhenNothingWasSaidForAWhile) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  StatusLine line(std::chrono::seconds(1));  // a busy machine may stop the test for a while
  line.show("too early");
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  EXPECT_TRUE(line.is_due());
  line.show("search 10 %");
  line.show("just said");
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  line.print("trial 1");
  EXPECT_FALSE(line.is_due()) << "a trial was said";
  line.clear();
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "trial 1\n") << "what stays, alone";
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "search 10 %\n");
}

TEST(StatusLine, IsSilentInAFileForAMinuteAtFirst) {
  ::testing::internal::CaptureStderr();
  StatusLine line;
  EXPECT_FALSE(line.is_due());
  line.show("search 1 %");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace rehearse::apps
