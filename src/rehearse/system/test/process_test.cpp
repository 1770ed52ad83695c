#include "rehearse/system/process.hpp"

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "rehearse/files/temporary_folder.hpp"

namespace rehearse::system {
namespace {

std::size_t a_line(std::string_view text) {
  const std::size_t end = text.find('\n');
  return end == std::string_view::npos ? 0 : end + 1;
}

Process::Outcome say(Process& process, const std::string& text, Process::Limits limits = {}) {
  return process.exchange(text, a_line, limits);
}

TEST(Process, AnswersAndItsFolderIsItsOwn) {
  Process process({"sh", "-c", "pwd; cat"}, "/");
  EXPECT_EQ(say(process, ""), Process::Outcome::answered);
  EXPECT_EQ(process.answer(), "/\n");
  const std::string long_line(3 << 20, 'x');  // more than a pipe holds
  EXPECT_EQ(say(process, long_line + "\n", {.seconds = 10, .bytes = 4 << 20}), Process::Outcome::answered);
  EXPECT_EQ(process.answer(), long_line + "\n");
}

TEST(Process, ThereIsNoShellAndNoSignalOfOurs) {
  EXPECT_THROW(Process({"exit 0"}, ""), std::system_error);
  Process process({"echo", "$HOME; `ls`"}, "");
  EXPECT_EQ(say(process, ""), Process::Outcome::answered);
  EXPECT_EQ(process.answer(), "$HOME; `ls`\n");
}

TEST(Process, HowItFailsIsSaid) {
  Process ended({"sh", "-c", "echo why >&2; exit 7"}, "");
  EXPECT_EQ(say(ended, "x\n"), Process::Outcome::ended);
  EXPECT_EQ(ended.end(), "it ended with exit status 7");
  EXPECT_EQ(ended.last_words(), "why\n");
  Process killed({"sh", "-c", "kill -9 $$"}, "");
  EXPECT_EQ(say(killed, ""), Process::Outcome::ended);
  EXPECT_EQ(killed.end(), "it was ended by signal 9 (Killed)");
  Process late({"sleep", "100"}, "");
  EXPECT_EQ(say(late, "x\n", {.seconds = 0.1}), Process::Outcome::late);
  Process flood({"sh", "-c", "yes | tr -d '\\n'"}, "");
  EXPECT_EQ(say(flood, "", {.seconds = 10, .bytes = 1000}), Process::Outcome::flooded);
}

TEST(Process, AnAnswerBeforeTheQuestionIsNone) {
  Process twice({"sh", "-c", "while read line; do printf '%s\\n%s\\n' $line $line; done"}, "");  // in one piece
  ASSERT_EQ(say(twice, "a\n"), Process::Outcome::answered);
  EXPECT_EQ(say(twice, "b\n"), Process::Outcome::unasked);
  EXPECT_EQ(twice.unused(), "a\n");
  Process greets({"sh", "-c", "echo hello; read line; echo $line"}, "");
  EXPECT_EQ(say(greets, ""), Process::Outcome::answered) << "by itself";
  EXPECT_EQ(say(greets, "b\n"), Process::Outcome::answered);
  EXPECT_EQ(greets.answer(), "b\n");
}

TEST(Process, OneThatDoesNotReadDoesNoHarm) {
  Process process({"sh", "-c", "exec <&-; echo closed; sleep 100"}, "");
  EXPECT_EQ(say(process, std::string(10 << 20, 'x'), {.seconds = 5}), Process::Outcome::answered);
  EXPECT_EQ(say(process, "again\n", {.seconds = 0.1}), Process::Outcome::late);
}

/// A process that ended may be there until somebody asks how.
bool is_alive(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return file >> number >> name >> state && state != "Z";
}

TEST(Process, ItsChildrenEndWithIt) {
  pid_t child = 0;
  {
    Process process({"sh", "-c", "sleep 100 & echo $!; wait"}, "");
    ASSERT_EQ(say(process, ""), Process::Outcome::answered);
    child = std::stoi(std::string(process.answer()));
    EXPECT_TRUE(is_alive(child));
  }
  for (int i = 0; i < 100 && is_alive(child); ++i) usleep(10000);
  EXPECT_FALSE(is_alive(child));
}

/// A driver that takes a fifth of a second after the end of its input, and writes to both of its streams on the way.
std::vector<std::string> driver(const std::string& mark) {
  return {"sh", "-c", "echo on; while read line; do :; done; sleep 0.2; echo off; echo off >&2; echo off > \"$0\"",
          mark};
}

TEST(Process, OneThatDidNoWrongEndsByItself) {
  const files::TemporaryFolder folder;
  const auto mark = folder.path() / "off";
  {
    Process process(driver(mark), "");
    ASSERT_EQ(say(process, ""), Process::Outcome::answered);
  }
  EXPECT_TRUE(std::filesystem::exists(mark));
}

TEST(Process, OneThatIsLateOrWrongIsKilledAtOnce) {
  const files::TemporaryFolder folder;
  for (const bool late : {false, true}) {
    const auto mark = folder.path() / (late ? "late" : "wrong");
    {
      Process process(driver(mark), "");
      ASSERT_EQ(say(process, ""), Process::Outcome::answered);
      if (late)
        EXPECT_EQ(say(process, "x\n", {.seconds = 0.1}), Process::Outcome::late);
      else
        process.distrust();
    }
    usleep(500'000);
    EXPECT_FALSE(std::filesystem::exists(mark)) << late;
  }
}

// A second for all; each would have its own.
TEST(Process, SeveralThatGoOnAreWaitedForTogether) {
  std::array<std::optional<Process>, 5> processes;
  for (auto& process : processes) process.emplace(std::vector<std::string>{"sh", "-c", "echo on; exec sleep 100"}, "");
  for (auto& process : processes) ASSERT_EQ(say(*process, ""), Process::Outcome::answered);
  const auto begin = std::chrono::steady_clock::now();
  for (auto& process : processes) process->leave();
  for (auto& process : processes) process.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(4));
}

TEST(KillPrograms, LetsThemEndBefore) {
  const files::TemporaryFolder folder;
  const auto mark = folder.path() / "off";
  const auto end = [&] {
    Process process(driver(mark), "");
    Process other({"sh", "-c", "echo $$; exec sleep 100"}, "");
    const bool on = say(process, "") == Process::Outcome::answered && say(other, "") == Process::Outcome::answered;
    const pid_t endless = std::stoi(std::string(other.answer()));
    kill_programs();
    for (int i = 0; i < 100 && is_alive(endless); ++i) usleep(10000);
    _exit(on && std::filesystem::exists(mark) && !is_alive(endless) ? 7 : 1);
  };
  EXPECT_EXIT(end(), ::testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace rehearse::system
