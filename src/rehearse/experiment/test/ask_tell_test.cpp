#include "rehearse/experiment/ask_tell.hpp"

#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/experiment/run.hpp"
#include "rehearse/experiment/run_folder.hpp"
#include "rehearse/experiment/spec_file.hpp"
#include "rehearse/files/write.hpp"
#include "wrapped.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

using fake::line_spec, fake::lines_of, fake::message_of;

fs::path trial_of(const fs::path& run, Index trial) { return run / fmt::format("trajectories/trial-{:03}.csv", trial); }
bool has_note(const TellResult& told, const std::string& note) { return is_among(note, told.trial->notes); }

/// A run that Rehearse drives, and one that is told its trials.
class AskTell : public ::testing::Test {
 protected:
  AskTell() {
    start_run(fake::catalogue(), line_spec(kTrials), driven, {});
    start_run(fake::catalogue(), line_spec(0), told, {});
  }

  AskResult ask(const fs::path& folder) { return ask_run(fake::catalogue(), folder, {}); }
  TellResult tell(const fs::path& folder, const std::vector<fs::path>& files, std::optional<Stop> stopped = {}) {
    return tell_run(fake::catalogue(), folder, {files, std::move(stopped)}, {});
  }
  TakeBackResult take_back(const fs::path& folder) { return experiment::take_back(fake::catalogue(), folder, {}); }
  fs::path written(const std::string& name, const std::string& text) {
    files::write_file(folder / name, text);
    return folder / name;
  }
  /// The first rows of a file, with its header.
  fs::path beginning(const fs::path& file, std::size_t rows) {
    const auto lines = lines_of(file);
    std::string text;
    for (std::size_t i = 0; i <= rows; ++i) text += lines.at(i) + "\n";
    return written("beginning.csv", text);
  }
  std::string checkpoint() { return files::read_file(told / "checkpoint"); }

  static constexpr Index kTrials = 3;
  const fs::path folder = fake::test_folder(), driven = folder / "driven", told = folder / "told";
};

TEST_F(AskTell, TrialsThatAreToldAreThoseThatAreDriven) {
  EXPECT_FALSE(fs::exists(told / "done"));
  for (Index trial = 1; trial <= kTrials; ++trial) {
    EXPECT_EQ(ask(told).trial.trial, trial);
    EXPECT_EQ(ask(told).trial.trial, trial) << "asked again, it is the same trial";
    EXPECT_TRUE(fs::exists(told / "next/policy.json"));
    const TellResult result = tell(told, {trial_of(driven, trial)});
    ASSERT_TRUE(result.trial);
    EXPECT_EQ(result.trial->trial, trial);
    EXPECT_FALSE(fs::exists(told / "next")) << "nobody runs an old policy again";
  }
  for (const char* file : {"trials.csv", "errors.csv", "identifiability.csv", "notes.csv", "policy.json",
                           "trajectories/trial-002.csv", "predictions/trial-003.csv", "memories.csv"})
    EXPECT_EQ(files::read_file(told / file), files::read_file(driven / file)) << file;
}

TEST_F(AskTell, AnEpisodeIsKeptWhateverFailsThen) {
  bool broken = false;
  ask_run(fake::fragile(broken), told, {});
  broken = true;
  const TellRequest first{{trial_of(driven, 1)}, {}};
  EXPECT_THROW(tell_run(fake::fragile(broken), told, first, {}), RunFailed);
  EXPECT_EQ(status_of(fake::catalogue(), told).run.history.done(), 1);
  EXPECT_FALSE(fs::exists(told / "next"));
  broken = false;
  EXPECT_TRUE(tell_run(fake::fragile(broken), told, first, {}).known_before);
  for (Index trial = 2; trial <= kTrials; ++trial) {
    ask(told);
    tell(told, {trial_of(driven, trial)});
  }
  for (const char* file : {"trials.csv", "errors.csv", "memories.csv"})
    EXPECT_EQ(files::read_file(told / file), files::read_file(driven / file)) << file;
}

TEST_F(AskTell, AFileCountsOnce) {
  ask(told);
  tell(told, {trial_of(driven, 1)});
  const std::string before = checkpoint();
  const TellResult again = tell(told, {trial_of(driven, 1)});
  EXPECT_TRUE(again.known_before);
  ASSERT_TRUE(again.trial);
  EXPECT_EQ(again.trial->trial, 1);
  EXPECT_EQ(checkpoint(), before);
  ask(told);
  const TellResult once_more = tell(told, {trial_of(driven, 1)});
  EXPECT_TRUE(once_more.known_before && once_more.still_asked) << "trial 2 is to come";
}

TEST_F(AskTell, TheSameNumbersCountOnceWhateverTheBytes) {
  const auto with_windows_ends = [&](Index trial) {
    std::string text;
    for (const std::string& line : lines_of(trial_of(driven, trial))) text += line + "\r\n";
    return written("windows.csv", text);
  };
  ask(told);
  EXPECT_EQ(tell(told, {with_windows_ends(1)}).trial->trial, 1);
  ask(told);
  for (const fs::path& file : {trial_of(driven, 1), trial_of(told, 1)}) {
    const TellResult again = tell(told, {file});
    EXPECT_TRUE(again.known_before);
    EXPECT_EQ(again.trial->trial, 1);
  }
  EXPECT_FALSE(tell(told, {beginning(trial_of(driven, 1), 6)}, Stop{"a noise"}).known_before) << "it is shorter";
  ask(told);
  EXPECT_EQ(tell(told, {with_windows_ends(3)}).trial->trial, 3);
}

TEST_F(AskTell, AWholeFileAfterItsStoppedBeginningIsRefused) {
  ask(told);
  tell(told, {beginning(trial_of(driven, 1), 6)}, Stop{"a noise"});
  const std::string before = checkpoint();
  EXPECT_THROW(tell(told, {trial_of(driven, 1)}), InvalidInput);
  EXPECT_EQ(checkpoint(), before);
}

TEST_F(AskTell, AFileThatIsToldAgainCompletesWhatAKillLeftUndone) {
  ask(told);
  const std::string before = files::read_file(told / "next/policy.json");
  tell(told, {trial_of(driven, 1)});
  const std::string policy = files::read_file(told / "policy.json");
  files::write_file(told / "policy.json", "that of the trial before");
  fs::create_directories(told / "next");
  files::write_file(told / "next/policy.json", before);
  EXPECT_TRUE(tell(told, {trial_of(driven, 1)}).known_before);
  EXPECT_EQ(files::read_file(told / "policy.json"), policy);
  EXPECT_FALSE(fs::exists(told / "next")) << "nobody runs an old policy again";
}

TEST_F(AskTell, WhatIsNotToComeIsRefusedAndChangesNothing) {
  ask(told);
  const std::string asked = checkpoint();
  const auto refused = [&](const std::vector<fs::path>& files, std::optional<Stop> stopped = {}) {
    const std::string message = message_of<InvalidInput>([&] { tell(told, files, stopped); });
    EXPECT_EQ(checkpoint(), asked) << message;
    return message;
  };
  EXPECT_NE(refused({trial_of(driven, 2), trial_of(driven, 3)}).find("cannot learn from logs"), std::string::npos);
  EXPECT_NE(refused({trial_of(driven, 1), trial_of(driven, 2)}, Stop{"a noise"}).find("several files are logs"),
            std::string::npos);
  EXPECT_NE(refused({folder / "none.csv"}).find("none.csv"), std::string::npos);
  EXPECT_NE(refused({beginning(trial_of(driven, 1), 6)}).find("5 of 12 steps"), std::string::npos);
  EXPECT_NE(refused({trial_of(driven, 1)}, Stop{"a noise"}).find("has all its steps"), std::string::npos);
  const std::string whole = files::read_file(trial_of(driven, 1));
  const fs::path cut = written("cut.csv", whole.substr(0, whole.size() - 1));
  EXPECT_NE(refused({cut}).find("11 of 12 steps"), std::string::npos);
  EXPECT_NE(refused({cut}).find("How the file was read: the last row is left out"), std::string::npos);
  fs::resize_file(cut, std::uintmax_t{1} << 40);  // no memory would hold it
  EXPECT_NE(refused({cut}).find("must have at most 67108864"), std::string::npos);
  EXPECT_NE(refused({written("bad.csv", "time [s],x [m]\n0,1\n")}).find("bad.csv"), std::string::npos);
  tell(told, {trial_of(driven, 1)});
  EXPECT_NE(message_of<InvalidInput>([&] { tell(told, {trial_of(driven, 2)}); }).find("trial 2 was not asked for"),
            std::string::npos);
  ask(told);
  EXPECT_NE(message_of<InvalidInput>([&] {
              tell(told, {trial_of(driven, 2), trial_of(driven, 3)});
            }).find("one file tells it, but 2 are named"),
            std::string::npos);
}

/// Every file of a folder but those that were taken back, by its path there.
std::map<std::string, std::string> all_files(const fs::path& run) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(run))
    if (const fs::path name = entry.path().lexically_relative(run);
        entry.is_regular_file() && *name.begin() != "taken-back")
      all[name.string()] = files::read_file(entry.path());
  return all;
}

TEST_F(AskTell, WhatWasToldCanBeTakenBack) {
  std::vector<std::map<std::string, std::string>> before;
  for (Index trial = 1; trial <= kTrials; ++trial) {
    ask(told);
    before.push_back(all_files(told));
    tell(told, {trial_of(driven, trial)});
  }
  ask(told);  // a policy that was made of the wrong trial
  for (Index trial = kTrials; trial >= 1; --trial) {
    const TakeBackResult taken = take_back(told);
    EXPECT_EQ(taken.trial, trial);
    ASSERT_EQ(taken.files.size(), 1U);
    EXPECT_EQ(files::read_file(taken.files[0]), files::read_file(trial_of(driven, trial)));
    EXPECT_EQ(all_files(told), before[static_cast<std::size_t>(trial) - 1]) << trial;
  }
  EXPECT_NE(message_of<InvalidInput>([&] { take_back(told); }).find("no file was told"), std::string::npos);
  for (Index trial = 1; trial <= kTrials; ++trial) ask(told), tell(told, {trial_of(driven, trial)});
  for (const char* file : {"trials.csv", "errors.csv", "policy.json", "memories.csv"})
    EXPECT_EQ(files::read_file(told / file), files::read_file(driven / file)) << file;
}

TEST_F(AskTell, TakingBackGoesOnAfterAKill) {
  ask(told), tell(told, {trial_of(driven, 1)}), ask(told);
  const auto before = all_files(told);
  tell(told, {trial_of(driven, 2)});
  files::write_file(told / "checkpoint", before.at("checkpoint"));  // as far as that it came
  EXPECT_EQ(take_back(told).trial, 2);
  EXPECT_EQ(all_files(told), before);
}

TEST_F(AskTell, AnEndThatATellMovedIsMovedBack) {
  const auto end = [&] { return std::pair(files::read_file(driven / "spec.toml"), fs::exists(driven / "done")); };
  ask(driven);
  const auto before = end();
  tell(driven, {beginning(trial_of(driven, 2), 6)}, Stop{"a noise"}).trial.value();
  EXPECT_NE(end(), before);
  take_back(driven);
  EXPECT_EQ(end(), before);
  EXPECT_TRUE(before.second);
  EXPECT_NE(message_of<InvalidInput>([&] { take_back(driven); }).find("no file was told"), std::string::npos);
}

TEST_F(AskTell, WhatRehearseDroveIsNotTakenBack) {
  ask(told), tell(told, {trial_of(driven, 1)});
  resume_run(fake::catalogue(), told, Until(2), {});
  const std::string before = checkpoint();
  EXPECT_NE(message_of<InvalidInput>([&] { take_back(told); }).find("trial 2, the last, cannot be taken back"),
            std::string::npos);
  EXPECT_EQ(checkpoint(), before);
}

TEST_F(AskTell, AnOperatorMayStopAnEpisode) {
  ask(told);
  const TellResult failed = tell(told, {beginning(trial_of(driven, 1), 6)}, Stop{"it hit the wall"});
  ASSERT_TRUE(failed.trial);
  EXPECT_EQ(failed.trial->interaction_s, 0.5);
  EXPECT_EQ(failed.trial->solved, false);
  EXPECT_TRUE(has_note(failed, "the episode ended at the reward floor: stopped by the operator: it hit the wall"));
  ask(told);
  const TellResult stopped = tell(told, {beginning(trial_of(driven, 2), 6)}, Stop{"the battery", false});
  EXPECT_TRUE(has_note(stopped, "stopped by the operator after 5 of 12 steps, by no fault of the policy: the battery"));
  EXPECT_TRUE(stopped.trial->cut_short);
  EXPECT_EQ(stopped.trial->solved, std::nullopt);
  EXPECT_FALSE(failed.trial->cut_short);
  EXPECT_EQ(best_trial(status_of(fake::catalogue(), told).run.history.trials).trial, 1);
}

TEST_F(AskTell, AnotherPolicyThanTheOneAskedForIsNoted) {
  ask(told);
  const TellResult other = tell(told, {trial_of(driven, 2)});
  ASSERT_TRUE(other.trial);
  EXPECT_NE(other.trial->notes.back().find("v differs from what the policy says"), std::string::npos)
      << other.trial->notes.back();
}

TEST_F(AskTell, LearnersThatCannotUseLogsSaySoBeforeAnythingIsKept) {
  const std::string before = checkpoint();
  EXPECT_NE(message_of<InvalidInput>([&] { tell(told, {trial_of(driven, 1)}); }).find("cannot learn from logs"),
            std::string::npos);
  EXPECT_EQ(checkpoint(), before);
  EXPECT_FALSE(fs::exists(told / "told"));
}

TEST_F(AskTell, StatusReadsWithoutDisturbing) {
  EXPECT_EQ(status_of(fake::catalogue(), told).run.history.done(), 0);
  ask(told);
  tell(told, {trial_of(driven, 1)});
  const AskResult asked = ask(told);
  const RunFolder at_work = RunFolder::open(told);
  const RunStatus status = status_of(fake::catalogue(), told);
  EXPECT_TRUE(status.in_use);
  EXPECT_EQ(status.run.history.done(), 1);
  ASSERT_TRUE(status.run.history.asked);
  EXPECT_EQ(status.run.history.asked->theta, asked.trial.theta);
}

TEST_F(AskTell, ARunThatWasDrivenCanGoOnTold) {
  const fs::path longer = folder / "longer";
  start_run(fake::catalogue(), line_spec(kTrials + 1), longer, {});
  ask(driven);
  tell(driven, {trial_of(longer, kTrials + 1)});
  EXPECT_EQ(files::read_file(driven / "trials.csv"), files::read_file(longer / "trials.csv"));
  EXPECT_EQ(files::read_file(driven / "done"), "4 trials\n");
  EXPECT_EQ(files::read_file(driven / "spec.toml"), of_told_run(files::read_file(longer / "spec.toml")));
}

TEST_F(AskTell, ResumeDoesNotDriveARunThatIsTold) {
  EXPECT_NE(message_of<InvalidInput>([&] { resume_run(fake::catalogue(), told, {}, {}); }).find("`ask` and `tell`"),
            std::string::npos);
  ask(told);
  EXPECT_EQ(resume_run(fake::catalogue(), told, Until(1), {}).trials, 1) << "unless it is told how far";
}

}  // namespace
}  // namespace rehearse::experiment
