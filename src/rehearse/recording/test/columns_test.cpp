#include "rehearse/recording/columns.hpp"

#include <gtest/gtest.h>

#include "rehearse/recording/test/swing.hpp"

namespace rehearse::recording {
namespace {

TEST(Columns, AreFoundInAnyOrderAndConverted) {
  const auto table = files::read_csv("note,q (deg),torque,T [ms],dq [rpm]\na,180,1,-5,60\nb,90,-1,0,30\nc,,2,50,\n");
  Problems problems("f");
  std::vector<std::string> notes;
  const Channels found = find_channels(table, swing_task(), problems, notes);
  EXPECT_NO_THROW(problems.throw_if_any());
  ASSERT_EQ(found.states[1].samples.size(), 1U);  // one row is before the start, one has no angle
  EXPECT_DOUBLE_EQ(found.states[1].samples[0].value, std::acos(0.0));
  EXPECT_DOUBLE_EQ(found.states[0].samples[0].value, std::acos(-1.0));
  EXPECT_EQ(found.states[0].samples[0].row, 3);
  ASSERT_EQ(found.actions[0].samples.size(), 2U);
  EXPECT_DOUBLE_EQ(found.actions[0].samples[1].time_s, 0.05);
  EXPECT_TRUE(found.truths.empty());
  EXPECT_EQ(notes, (std::vector<std::string>{"converted: time from ms to s, dq from rpm to rad/s, q from deg to rad",
                                             "1 rows before time 0 are left out", "columns that are not used: note"}));
}

TEST(Columns, WithoutANameAreNoneToSpeakOf) {  // an index of pandas, a comma at the end
  const auto table = files::read_csv(",time,dq,q,torque,\n0,0,0,0,0,\n1,0.05,0,0,0,\n");
  Problems problems("f");
  std::vector<std::string> notes;
  find_channels(table, swing_task(), problems, notes);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(notes, std::vector<std::string>{});
}

/// The times of the samples of a table's first action.
std::vector<double> times_in(const std::string& text, Problems& problems) {
  std::vector<std::string> notes;
  std::vector<double> times;
  const Channels found = find_channels(files::read_csv(text), swing_task(), problems, notes);
  for (const Sample& sample : found.actions[0].samples) times.push_back(sample.time_s);
  return times;
}

TEST(Columns, TimeIsTakenBeforeItsOtherSpellingsAndThoseBeforeT) {
  const std::string rows = ",0,0,0\n0.1,7,9,0,0,0\n";
  for (const char* names : {"time,t,T", "time,Time,t", "TIME,t,T", "t,T,x"}) {
    Problems problems("f");
    EXPECT_EQ(times_in(names + std::string(",dq,q,torque\n0,6,8") + rows, problems), (std::vector<double>{0, 0.1}))
        << names;
    EXPECT_TRUE(problems.empty()) << names;
  }
}

}  // namespace
}  // namespace rehearse::recording
