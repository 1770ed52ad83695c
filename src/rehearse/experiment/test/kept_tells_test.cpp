#include "rehearse/experiment/kept_tells.hpp"

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/experiment/ask_tell.hpp"
#include "wrapped.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

/// A run that is told logs before its first trial. The contents of the files do not matter here.
class KeptTells : public ::testing::Test {
 protected:
  KeptTells() { start_run(fake::catalogue(), fake::line_spec(0), path, {}); }
  static ToldFile file(const std::string& name, const std::string& bytes) { return {"elsewhere/" + name, bytes, ""}; }
  /// Changes the run as if so many logs had been told by now.
  static void change(const RunFolder& run, std::size_t logs) {
    History history = run.load();
    const Episode episode{.states = Matrix::Zero(2, 1),
                          .true_states = Matrix::Zero(2, 1),
                          .actions = Matrix::Zero(1, 1),
                          .rewards = Vector::Zero(1)};
    history.logs.resize(logs, {.name = "log", .file_checksum = "", .episode = episode, .notes = {}});
    run.write_checkpoint(history);
  }

  const fs::path path = fake::test_folder() / "run";
};

TEST_F(KeptTells, HaveTheRunAndTheFilesOfEach) {
  const RunFolder run = RunFolder::open(path);
  const std::string first = files::read_file(path / "checkpoint");
  keep_tell(run, {file("a.csv", "A"), file("b.csv", "B")});
  change(run, 2);
  const std::string second = files::read_file(path / "checkpoint");
  keep_tell(run, {file("a.csv", "another")});
  change(run, 3);
  EXPECT_EQ(last_tell(run).files.size(), 1U);
  EXPECT_EQ(last_tell(run).before.logs.size(), 2U);
  EXPECT_FALSE(last_tell(run).trial());
  restore(run, last_tell(run));
  EXPECT_EQ(files::read_file(path / "checkpoint"), second);
  forget_tell(run);
  const std::vector<fs::path> kept = set_aside(run, last_tell(run));
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(files::read_file(kept[0]), "A");
  EXPECT_TRUE(kept[1].filename().string().ends_with("-b.csv"));
  restore(run, last_tell(run));
  EXPECT_EQ(files::read_file(path / "checkpoint"), first);
  forget_tell(run);
  EXPECT_FALSE(fs::exists(path / "told"));
  EXPECT_THROW(last_tell(run), InvalidInput);
}

TEST_F(KeptTells, OneThatNeverCameAboutGivesWay) {
  const RunFolder run = RunFolder::open(path);
  keep_tell(run, {file("a.csv", "A")});
  fs::create_directories(path / "told/.unfinished/files");  // of a kill
  keep_tell(run, {file("b.csv", "B")});
  EXPECT_EQ(files::read_file(last_tell(run).files.at(0)), "B");
  forget_tell(run);
  EXPECT_FALSE(fs::exists(path / "told/001"));
}

// A kill may come while a tell is removed.
TEST_F(KeptTells, OneThatIsHalfRemovedIsNone) {
  const RunFolder run = RunFolder::open(path);
  keep_tell(run, {file("a.csv", "A")});
  change(run, 1);
  keep_tell(run, {file("b.csv", "B")});
  change(run, 2);
  fs::create_directories(path / "told" / ".removed" / "before");
  EXPECT_EQ(last_tell(run).files.front().filename(), "001-b.csv");
  forget_tell(run);
  EXPECT_FALSE(fs::exists(path / "told" / ".removed"));
  change(run, 1);
  EXPECT_EQ(last_tell(run).files.front().filename(), "001-a.csv");
}

TEST_F(KeptTells, LongNamesAreCut) {
  const RunFolder run = RunFolder::open(path);
  std::string umlauts = "a";
  while (umlauts.size() < 249) umlauts += "ö";
  keep_tell(run,
            {file(std::string(245, 'a') + ".csv", "A"), file(umlauts, "B"), file("c." + std::string(240, 'c'), "C")});
  change(run, 3);
  const std::vector<fs::path> kept = set_aside(run, last_tell(run));
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_TRUE(kept[0].filename().string().ends_with("aaa.csv"));
  EXPECT_TRUE(kept[1].filename().string().ends_with("ö"));
  for (std::size_t i : {0U, 1U, 2U}) EXPECT_EQ(files::read_file(kept[i]), std::string(1, "ABC"[i]));
  const fs::path old = path / "told/001/files" / ("001-" + std::string(235, 'a') + ".csv");  // of an earlier version
  fs::rename(path / "told/001/files" / last_tell(run).files[0].filename(), old);
  EXPECT_EQ(set_aside(run, last_tell(run)), kept);
}

TEST_F(KeptTells, OneThatCannotBeKeptLeavesNothing) {
  const RunFolder run = RunFolder::open(path);
  fs::create_symlink("spec.toml", path / "done");  // which is refused
  EXPECT_THROW(keep_tell(run, {file("a.csv", "A")}), InvalidInput);
  EXPECT_FALSE(fs::exists(path / "told"));
}

TEST_F(KeptTells, TheLastOfAThousandIsTheThousandth) {
  const RunFolder run = RunFolder::open(path);
  keep_tell(run, {file("a.csv", "A")});
  change(run, 1);
  fs::rename(path / "told/001", path / "told/999");
  fs::create_directories(path / "told/99999999999999999999");  // of somebody else
  for (std::size_t logs : {2, 3}) {
    keep_tell(run, {file("b.csv", "B")});
    change(run, logs);
  }
  EXPECT_TRUE(fs::exists(path / "told/1000"));
  EXPECT_EQ(last_tell(run).folder.filename(), "1001");
}

TEST_F(KeptTells, ARunThatWentOnWithoutBeingToldStaysAsItIs) {
  const RunFolder run = RunFolder::open(path);
  keep_tell(run, {file("a.csv", "A")});
  change(run, 2);
  EXPECT_THROW(last_tell(run), InvalidInput);
}

TEST_F(KeptTells, ATrialThatWasDrivenAfterATellThatAKillInterruptedStays) {
  ask_run(fake::catalogue(), path, {});
  {
    const RunFolder run = RunFolder::open(path);
    keep_tell(run, {file("a.csv", "A")});
    EXPECT_EQ(last_tell(run).trial(), 1);
  }
  resume_run(fake::catalogue(), path, Until(1), {});
  const RunFolder run = RunFolder::open(path);
  EXPECT_NE(fake::message_of<InvalidInput>([&] { last_tell(run); }).find("Rehearse drove the robot"),
            std::string::npos);
}

TEST_F(KeptTells, ADiskThatRefusesIsAFailureOfTheRun) {
  ask_run(fake::catalogue(), path, {});
  files::write_file(path / "told", "where the folder must be");
  const fs::path driven = path.parent_path() / "driven";
  start_run(fake::catalogue(), fake::line_spec(1), driven, {});
  EXPECT_THROW(tell_run(fake::catalogue(), path, {{driven / "trajectories/trial-001.csv"}, {}}, {}), RunFailed);
}

/// Loses logs, and says whether a policy could be run whose trial is not asked for.
class LosesLogs final : public fake::Wrapped {
 public:
  LosesLogs(std::unique_ptr<learners::Learner> inner, const fs::path& run, bool& stale)
      : Wrapped(std::move(inner)), run_(run), stale_(stale) {}
  void study(const std::vector<Episode>& logs) override {
    if (logs.empty()) return;
    stale_ = fs::exists(run_ / "next") && !RunFolder::read(run_).history.asked;
    throw std::runtime_error("the logs are lost");
  }

 private:
  fs::path run_;
  bool& stale_;
};

TEST_F(KeptTells, APolicyThatLogsWouldHaveDroppedIsThereAgainWhereTheyAreNotKept) {
  const fs::path driven = path.parent_path() / "driven";
  start_run(fake::catalogue(), fake::line_spec(3), driven, {});
  const TellRequest logs{{driven / "trajectories/trial-002.csv", driven / "trajectories/trial-003.csv"}, {}};
  bool stale = false;
  const Catalogue loses =
      fake::catalogue_of([&](auto inner) { return std::make_unique<LosesLogs>(std::move(inner), path, stale); });
  ask_run(loses, path, {});
  const std::string checkpoint = files::read_file(path / "checkpoint"),
                    policy = files::read_file(path / "next/policy.json");
  const auto is_as_before = [&] {
    return files::holds(path / "checkpoint", checkpoint) && files::holds(path / "next/policy.json", policy);
  };
  EXPECT_THROW(tell_run(loses, path, logs, {}), RunFailed);
  EXPECT_FALSE(stale) << "a kill would have left it";
  EXPECT_TRUE(is_as_before());
  EXPECT_FALSE(fs::exists(path / "told"));
  fs::create_symlink("spec.toml", path / "done");  // so that nothing can be kept
  EXPECT_THROW(tell_run(loses, path, logs, {}), InvalidInput);
  EXPECT_TRUE(is_as_before());
}

TEST_F(KeptTells, TheSpecOfARunThatWasToBeDrivenSaysThatItWasTold) {
  const fs::path driven = path.parent_path() / "driven", stopped = path.parent_path() / "stopped";
  start_run(fake::catalogue(), fake::line_spec(3), driven, {});
  EXPECT_THROW(start_run(fake::catalogue(), fake::line_spec(3), stopped, {.stop = [] { return true; }}), Interrupted);
  const auto first_line = [&] { return fake::lines_of(stopped / "spec.toml").front(); };
  const std::string before = files::read_file(stopped / "spec.toml");
  ask_run(fake::catalogue(), stopped, {});
  EXPECT_NE(first_line().find("gives the same trials.csv"), std::string::npos);
  tell_run(fake::catalogue(), stopped, {{driven / "trajectories/trial-001.csv"}, {}}, {});
  EXPECT_NE(first_line().find("that is told of its robot"), std::string::npos) << first_line();
  take_back(fake::catalogue(), stopped, {});
  EXPECT_EQ(files::read_file(stopped / "spec.toml"), before);
}

}  // namespace
}  // namespace rehearse::experiment
