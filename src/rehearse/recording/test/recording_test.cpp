#include "rehearse/recording/recording.hpp"

#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/files/temporary_folder.hpp"
#include "rehearse/recording/test/swing.hpp"

namespace rehearse::recording {
namespace {

std::string refusal(const std::string& text, const ReadOptions& options = {}) {
  try {
    read_recording(text, "log.csv", swing_task(), options);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "it was read";
}

TEST(Recording, ATrialOfARunIsReadToTheSameBytes) {
  const std::string text =
      "time [s],dq [rad/s],q [rad],true dq [rad/s],true q [rad],torque [N m],reward\n"
      "0,0.201,3.14,0.01,3.141592653589793,0.3,\n"
      "0.05,0.202,3.15,0.11,3.1500000000000004,-0.7,0.001\n"
      "0.1,0.203,3.16,0.21,3.25,2,0.002\n"
      "0.15000000000000002,0.204,3.17,0.31,3.35,,0.003\n";
  const auto [episode, notes, off_s, unaveraged] = read_recording(text, "trial-003.csv", swing_task());
  EXPECT_EQ(episode.states, (Matrix{{0.201, 3.14}, {0.202, 3.15}, {0.203, 3.16}, {0.204, 3.17}}));
  EXPECT_EQ(episode.true_states,
            (Matrix{{0.01, 3.141592653589793}, {0.11, 3.1500000000000004}, {0.21, 3.25}, {0.31, 3.35}}));
  EXPECT_EQ(episode.actions, (Matrix{{0.3}, {-0.7}, {2}}));
  EXPECT_EQ(episode.rewards, Vector::Zero(3));
  EXPECT_FALSE(episode.ended);
  EXPECT_TRUE(notes.empty());
}

TEST(Recording, SaysWhenAClockOfTheDayBegins) {
  const std::string text =
      "time,dq,q,torque\n1700000000.5,0.2,3.14,0.3\n1700000000.55,0.2,3.15,-0.7\n1700000000.6,0.2,3.16,\n";
  const auto [episode, notes, off_s, unaveraged] = read_recording(text, "log.csv", swing_task());
  ASSERT_FALSE(notes.empty());
  EXPECT_EQ(notes.front(), "step 0 is at 1700000000.5 s, the first time at which all columns have numbers");
}

// The memory of actuators follows from the actions, and is never read.
TEST(Recording, HasTheMemoryOfActuators) {
  Task task = swing_task();
  task.actions[0].actuation = {.delay_s = 0.1, .lag_s = 0.03};
  task = with_memory(task);
  const std::string text =
      "time,dq,q,torque_last,torque\n0,0.2,3.14,9,0.3\n0.05,0.2,3.15,9,-0.7\n0.1,0.2,3.16,9,2\n0.15,0.2,3.17,9,\n";
  const auto [episode, notes, off_s, unaveraged] = read_recording(text, "log.csv", task);
  EXPECT_TRUE(notes.empty());
  ASSERT_EQ(episode.states.cols(), 5);
  EXPECT_EQ(episode.states.leftCols(2), (Matrix{{0.2, 3.14}, {0.2, 3.15}, {0.2, 3.16}, {0.2, 3.17}}));
  EXPECT_EQ(episode.states.middleCols(2, 2), (Matrix{{0, 0}, {0.3, 0}, {-0.7, 0.3}, {2, -0.7}}));
  EXPECT_NEAR(episode.states(3, 4), 0.3 * (1 - std::exp(-0.05 / 0.03)), 1e-15);
  EXPECT_EQ(episode.true_states, episode.states);
}

TEST(Recording, AnotherRateIsResampled) {
  const auto [episode, notes, off_s, unaveraged] = read_recording(swing_csv(500, 0.0033), "log.csv", swing_task());
  ASSERT_EQ(episode.steps(), 32);
  for (Index k = 0; k <= episode.steps(); ++k) {
    const double t = static_cast<double>(k) * 0.05;
    EXPECT_NEAR(episode.states(k, 1), std::sin(3 * t), 2e-5);
    if (k == episode.steps()) break;
    EXPECT_NEAR(episode.actions(k, 0), (std::sin(t + 0.05) - std::sin(t)) / 0.05, 2e-3);
  }
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0],
            "rows are 0.0033 s apart on average: states are interpolated linearly in 32 of 32 control steps of 0.05 s; "
            "actions are means of what rows hold until the next, in 32 of 32");
}

TEST(Recording, ALoopThatIsALittleLateIsSaidToBeSo) {
  std::string late = "time,dq,q,torque\n";
  for (int k = 0; k <= 40; ++k) late += fmt::format("{},0.2,{},0\n", 0.05 * k + (k % 2 == 0 ? 1e-4 : 3e-4), 0.01 * k);
  const auto [episode, notes, off_s, unaveraged] = read_recording(late, "log.csv", swing_task());
  EXPECT_EQ(episode.steps(), 40);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "rows are up to 0.0002 s off the control steps of 0.05 s: numbers are interpolated");
  EXPECT_NEAR(off_s, 2e-4, 1e-12);
}

TEST(Recording, ALoopThatIsSlowerThanTheTaskIsSaidToBeSo) {
  const auto notes = read_recording(swing_csv(41, 0.055), "log.csv", swing_task()).notes;
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("A loop that runs so makes control steps of 0.055 s, where the task has 0.05 s"),
            std::string::npos)
      << notes[0];
}

TEST(Recording, LinesThroughRowsAreSaidOnlyWhereThereAreSuch) {
  const auto said = [](const std::string& text) {
    return read_recording(text, "log.csv", swing_task(), {.average = true}).notes.at(0);
  };
  EXPECT_NE(said(swing_csv(500, 0.0033)).find("states are on lines through the rows around them"), std::string::npos);
  EXPECT_NE(said(swing_csv(41, 0.055)).find("states are interpolated linearly"), std::string::npos);
}

TEST(Recording, StatesAreKeptAsTheyWereBeforeAveraging) {
  Task task = swing_task();
  task.actions[0].actuation = {.lag_s = 0.03};
  task = with_memory(task);
  const Recording plain = read_recording(swing_csv(500, 0.0033), "log.csv", task);
  const Recording averaged = read_recording(swing_csv(500, 0.0033), "log.csv", task, {.average = true});
  EXPECT_EQ(plain.unaveraged.size(), 0);
  EXPECT_EQ(averaged.unaveraged, plain.episode.states.leftCols(2));
  EXPECT_NE(averaged.unaveraged, averaged.episode.states.leftCols(2));
}

TEST(Recording, CellsThatAreEmptyAreSaidToBeSo) {
  const auto notes = read_recording(with_cell(swing_csv(), 9, 3, ""), "log.csv", swing_task()).notes;
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "cells are empty at 1 of 40 control steps: numbers are interpolated there");
}

// Rows that are missing here and there are no loop that is too slow, and are not far from most control steps.
TEST(Recording, CellsAndRowsThatAreMissingAreNoSlowLoop) {
  const auto said = [](const std::string& text) {
    const Recording read = read_recording(text, "log.csv", swing_task());
    EXPECT_EQ(read.notes.size(), 1U);
    EXPECT_LT(read.off_s, 1e-9);
    return read.notes.at(0);
  };
  EXPECT_EQ(said(with_cell(swing_csv(), 9, 2, "")),
            "cells are empty at 1 of 40 control steps: numbers are interpolated there")
      << "of the first state, too";
  std::string text = swing_csv();
  for (const Index row : {9, 20, 31}) text = with_cell(with_cell(text, row, 2, ""), row, 3, "");
  EXPECT_EQ(said(text), "no row with numbers is near 3 of 40 control steps: they are interpolated there");
}

TEST(Recording, WhatEditorsAndRobotsLeaveDoesNoHarm) {
  const Episode plain = read_recording(swing_csv(), "log.csv", swing_task()).episode;
  std::string windows = "\xEF\xBB\xBF" + swing_csv();
  for (std::size_t at = 0; (at = windows.find('\n', at)) != std::string::npos; at += 2) windows.replace(at, 1, "\r\n");
  EXPECT_EQ(read_recording(windows + "\r\n", "log.csv", swing_task()).episode.states, plain.states);
  EXPECT_EQ(read_recording(with_cell(swing_csv(), 9, 3, " "), "log.csv", swing_task()).episode.steps(), plain.steps());
  const std::string cut = swing_csv() + "2.05,1.2,0.";
  const auto [episode, notes, off_s, unaveraged] = read_recording(cut, "log.csv", swing_task());
  EXPECT_EQ(episode.states, plain.states);
  EXPECT_EQ(notes[0], "the last row is left out: it has no end, so that it may be cut short");
  EXPECT_EQ(read_recording(swing_csv(), "log.csv", swing_task(), {.max_steps = 7}).episode.steps(), 7);
}

TEST(Recording, FilesAreReadAndLargeOnesAreNot) {
  const files::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "log.csv";
  std::ofstream(path) << swing_csv();
  EXPECT_EQ(read_bytes(path), swing_csv());
  EXPECT_THROW(read_bytes(path, {.max_bytes = 100}), InvalidInput);
  EXPECT_THROW(read_bytes(folder.path() / "none.csv"), InvalidInput);
  EXPECT_THROW(read_bytes(folder.path()), InvalidInput);
}

/// A swing whose times, under this title, count so many a second.
std::string swing_counting(double per_s, const std::string& title) {
  std::string text = swing_csv(41, 0.05, title + ",dq,q,torque");
  for (int k = 0; k < 41; ++k) text = with_cell(text, k + 2, 1, files::Csv::cell(std::round(k * 0.05 * per_s)));
  return text;
}

TEST(Recording, TimesThatLookLikeMillisecondsAreToldHowToSayIt) {
  const std::string gap = "log.csv: row 3: dq has no number for 50 s, must have one every 0.15 s at least";
  const std::string said = refusal(swing_counting(1e3, "t"));
  EXPECT_EQ(
      said.find("log.csv: row 1: t has no unit, so it is in s, but looks like milliseconds (rows are 50 apart): if "
                "it is, call the column 't [ms]'\n" +
                gap),
      0u)
      << said;
  EXPECT_EQ(refusal(swing_counting(1e3, "t [s]")).find("log.csv: row 1: t is in s, but looks like milliseconds"), 0u);
  EXPECT_EQ(refusal(swing_counting(1e6, "t [ms]")).find("log.csv: row 1: t is in ms, but looks like microseconds"), 0u);
  EXPECT_EQ(read_recording(swing_counting(1e3, "t [ms]"), "log.csv", swing_task()).episode.steps(), 40);
  EXPECT_NE(refusal(swing_counting(1e6, "time")).find("looks like microseconds"), std::string::npos);
  EXPECT_EQ(refusal(swing_csv(20, 0.5, "time,dq,q,torque")).find("looks like"), std::string::npos) << "rows of 0.5 s";
}

struct Wrong {
  std::string text, message;
};

TEST(Recording, WrongFilesAreRefusedWithWhatIsWrong) {
  const std::string good = swing_csv(), header = "time [s],dq [rad/s],q [rad],torque [N m]\n";
  const auto titled = [&](const std::string& titles) { return swing_csv(41, 0.05, titles); };
  const auto cell = [&](int row, int column, const std::string& text) { return with_cell(good, row, column, text); };
  const std::vector<Wrong> all = {
      {"", "log.csv: the file is empty"},
      {"time,u\r0,1\r", "log.csv: its lines end with CR alone, must end with LF or CR LF"},
      {"time", "log.csv: there is no row: no line of it has an end"},
      {"\n", "log.csv: row 1: there is no column dq"},
      {header, "log.csv: there is no row below the header"},
      {std::string("PK\x03\x04\n", 5), "log.csv: it is no text: there are control characters in it"},
      {good + std::string(1, '\0') + "\n", "log.csv: it is no text: there are control characters in it"},
      {"time;dq;q;torque\n0;0;0;0\n", "log.csv: columns are separated by ';', must be by ','"},
      {"time\tdq\tq\ttorque\n0\t0\t0\t0\n", "log.csv: columns are separated by tabs, must be by ','"},
      {"time;dq;q;torque\n0,05;0;0;0\n",
       "log.csv: columns are separated by ';', must be by ',', and decimals have a comma, must have a point: "
       "sed 's/,/./g; s/;/,/g' makes it so"},
      {cell(5, 2, "\"1,5\""), "log.csv: row 5: dq = '1,5', must be a finite number, whose decimals have a point"},
      {header + "0,1,2\n", "log.csv: row 2 has 3 cells, the header has 4"},
      {header + "0,1,2,1,5\n", "log.csv: row 2 has 5 cells, the header has 4"},
      {good + "\n" + good, "log.csv: row 43 has 1 cells, the header has 4"},
      {header + "0,\"1,2,3\n", "log.csv: row 2 is cut short"},
      {titled("time,dq,qq,torque"), "log.csv: row 1: there is no column q; unused columns: qq"},
      {titled("time,dq,q,force"), "log.csv: row 1: there is no column torque; unused columns: force"},
      {titled("clock,dq,q,torque"), "log.csv: row 1: there is no column time; unused columns: clock"},
      {titled("time,q,q,torque"), "log.csv: row 1: there are 2 columns q"},
      {"t,Time,TIME,dq,q,torque\n0,0,0,0,0,0\n",
       "log.csv: row 1: the columns TIME, Time are all the time, must be one"},
      {"0,0,0,0\n0.05,0,0,0\n", "log.csv: row 1: it has numbers, must have the names of columns"},
      {titled("time,dq,q [m],torque"), "log.csv: row 1: q is in 'm', must be in rad, deg, °"},
      {titled("time,dq [rad],q,torque"), "log.csv: row 1: dq is in 'rad', must be in rad/s, deg/s, °/s, rpm"},
      {titled("time [weeks],dq,q,torque"), "log.csv: row 1: time is in 'weeks', must be in s, ms, us, µs, ns"},
      {cell(5, 2, "nan"), "log.csv: row 5: dq = 'nan', must be a finite number"},
      {cell(5, 2, "1,5"), "log.csv: row 5 has 5 cells, the header has 4"},
      {cell(6, 3, "error"), "log.csv: row 6: q = 'error', must be a finite number"},
      {cell(6, 4, "inf"), "log.csv: row 6: torque = 'inf', must be a finite number"},
      {cell(6, 4, "1e300"), "log.csv: row 6: torque = 1e+300, must be within ± 1000000000000"},
      {cell(6, 1, ""), "log.csv: row 6: there is no time"},
      {cell(6, 1, "O.2"), "log.csv: row 6: time = 'O.2', must be a finite number"},
      {cell(6, 1, "0.15000000000000002"), "log.csv: row 6: time = 0.15000000000000002 s is that of the row before"},
      {cell(6, 1, "0.12"), "log.csv: row 6: time = 0.12 s, must be after the 0.15000000000000002 s of the row before"},
      {cell(42, 1, "9"),
       "log.csv: row 42: dq has no number for 7.05 s, must have one every 0.15 s at least (3 control steps)"},
      {cell(7, 4, "2.1"), "log.csv: row 7: torque = 2.1 N m, must be in -2 to 2"},
      {cell(20, 3, "100"), "log.csv: row 20: q jumps from"},
      {cell(20, 2, "-400"), "log.csv: row 20: dq jumps from"},
      {titled("time [ms],dq,q,torque"),
       "log.csv: all columns together cover 0.002 s, must cover a control step of 0.05 s"},
      {titled("q,dq,time,torque"), "must be after the"},
      {header + "-2,0,0,0\n-1,0,0,0\n", "log.csv: dq has no number at a time ≥ 0"},
      {header + "0,,0,0\n0.05,,0,0\n", "log.csv: dq has no number at a time ≥ 0"},
      {swing_csv(20, 0.5),
       "log.csv: row 3: dq has no number for 0.5 s, must have one every 0.15 s at least (3 control steps)"},
  };
  for (const Wrong& wrong : all) {
    const std::string said = refusal(wrong.text);
    EXPECT_NE(said.find(wrong.message), std::string::npos) << said << "\nand not\n" << wrong.message;
  }
}

TEST(Recording, AllThatIsWrongIsSaidAtOnce) {
  std::string text = with_cell(swing_csv(), 5, 2, "x");
  for (int row = 7; row < 12; ++row) text = with_cell(text, row, 4, "y");
  EXPECT_EQ(refusal(text),
            "log.csv: row 5: dq = 'x', must be a finite number\n"
            "log.csv: row 7: torque = 'y', must be a finite number (and so in 4 more rows)");
}

}  // namespace
}  // namespace rehearse::recording
