#include "rehearse/experiment/run_folder.hpp"

#include <array>
#include <barrier>
#include <exception>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/core/errors.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

using fake::line_spec;

TEST(RunFolder, AnExistingFolderIsNeverOverwritten) {
  const fs::path folder = fake::test_folder();
  start_run(fake::catalogue(), line_spec(1), folder / "run", {});
  fs::create_directory(folder / "empty");
  std::ofstream(folder / "file") << "mine";
  for (const std::string name : {"run", "run/", "empty", "file"}) {
    const auto message =
        fake::message_of<InvalidInput>([&] { start_run(fake::catalogue(), line_spec(1), folder / name, {}); });
    EXPECT_NE(message.find("already exists"), std::string::npos) << name;
  }
  EXPECT_EQ(files::read_file(folder / "file"), "mine");
}

TEST(RunFolder, ASpecThatCouldNotBeReadBackIsRefusedBeforeThereIsAFolder) {
  const fs::path folder = fake::test_folder();
  Spec spec = line_spec(1);
  spec.options = {{"learner.a\x7f", "1"}};
  const auto message = fake::message_of<InvalidInput>([&] { RunFolder::create(folder / "run", spec, {}, {}); });
  EXPECT_TRUE(message.starts_with("a run of this spec could not be opened again")) << message;
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(RunFolder, ARunWhoseOptionBeginsAnotherIsOpened) {
  const fs::path run = fake::test_folder() / "run";
  Spec spec = line_spec(1);
  spec.options = {{"scenario.plant.lag_s", "1"}, {"scenario.plant.lag_s.f", "2"}};
  RunFolder::create(run, spec, {}, {});
  EXPECT_EQ(RunFolder::open(run).spec().options, spec.options);
  EXPECT_EQ(RunFolder::read(run).history.done(), 0);
}

TEST(RunFolder, FilesOfOthersStayBesideTheNextPolicy) {
  const fs::path path = fake::test_folder() / "run";
  const RunFolder folder = RunFolder::create(path, line_spec(1), {}, {});
  folder.write_next("policy.json", "{}");
  fs::create_directories(path / "next/__pycache__");
  std::ofstream(path / "next/raw.csv") << "mine";
  folder.remove_next();
  EXPECT_FALSE(fs::exists(path / "next/policy.json") || fs::exists(path / "next/__pycache__"));
  EXPECT_EQ(files::read_file(path / "next/raw.csv"), "mine");
  fs::remove(path / "next/raw.csv");
  folder.remove_next();
  EXPECT_FALSE(fs::exists(path / "next"));
}

TEST(RunFolder, TwoThreadsDoNotMakeOneFolder) {
  const fs::path folder = fake::test_folder();
  for (int i = 0; i < 20; ++i) {
    const fs::path run = folder / std::to_string(i);
    std::array<std::string, 2> refusals;
    std::array<std::exception_ptr, 2> failures;
    std::barrier both(2);
    const auto make = [&](std::size_t thread) {
      both.arrive_and_wait();
      try {
        RunFolder::create(run, line_spec(1), {}, {});
      } catch (const InvalidInput& error) {
        refusals[thread] = error.what();
      } catch (...) {
        failures[thread] = std::current_exception();
      }
    };
    std::thread other(make, 1);
    make(0);
    other.join();
    for (const std::exception_ptr& failure : failures) EXPECT_FALSE(failure);
    EXPECT_NE((refusals[0] + refusals[1]).find("already exists"), std::string::npos);
    EXPECT_NE(refusals[0].empty(), refusals[1].empty());
    EXPECT_TRUE(fs::exists(run / "checkpoint"));
  }
}

TEST(RunFolder, IsRefusedWhereItIsNone) {
  const fs::path folder = fake::test_folder();
  const auto complaint = [&](const std::string& name) {
    return fake::message_of<InvalidInput>([&] { resume_run(fake::catalogue(), folder / name, {}, {}); });
  };
  EXPECT_NE(complaint("nothing").find("nothing is not a folder"), std::string::npos);
  fs::create_directory(folder / "empty");
  EXPECT_NE(complaint("empty").find("is not a run folder: it has no spec.toml"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(folder / "empty"));

  start_run(fake::catalogue(), line_spec(2), folder / "run", {});
  const std::string spec = files::read_file(folder / "run/spec.toml"),
                    checkpoint = files::read_file(folder / "run/checkpoint");
  files::write_file(folder / "run/checkpoint", checkpoint.substr(0, checkpoint.size() / 2));
  EXPECT_NE(complaint("run").find("the checkpoint is truncated or damaged"), std::string::npos);
  files::write_file(folder / "run/checkpoint", checkpoint);
  files::write_file(folder / "run/spec.toml", spec.substr(0, spec.find('\n', spec.size() / 2) + 1) + "= =");
  EXPECT_NE(complaint("run").find("spec.toml: line "), std::string::npos);
  files::write_file(folder / "run/spec.toml", spec + "# harmless\n");
  EXPECT_EQ(complaint("run"), "");
  files::write_file(folder / "run/spec.toml", std::string(spec).replace(spec.find("seed = 3"), 8, "seed = 4"));
  EXPECT_NE(complaint("run").find("belongs to another spec.toml"), std::string::npos);
}

TEST(RunFolder, WritesIntoNoFolderOfOthers) {
  const fs::path folder = fake::test_folder(), run = folder / "run", theirs = folder / "theirs";
  start_run(fake::catalogue(), line_spec(1), run, {});
  fs::rename(run / "trajectories", theirs);
  fs::create_directory_symlink(theirs, run / "trajectories");
  const auto message = fake::message_of<InvalidInput>([&] { resume_run(fake::catalogue(), run, Until(2), {}); });
  EXPECT_EQ(message, (run / "trajectories").string() + " is a link, must be a folder of the run");
}

TEST(RunFolder, AnEndThatCannotBeWrittenChangesNothing) {
  const fs::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(1), folder, {});
  const std::string spec = files::read_file(folder / "spec.toml");
  fs::create_directory(folder / "spec.toml.tmp");  // in the way, as a full disk is
  EXPECT_THROW(resume_run(fake::catalogue(), folder, Until(2), {}), std::runtime_error);
  EXPECT_EQ(files::read_file(folder / "spec.toml"), spec);
  EXPECT_TRUE(fs::exists(folder / "done"));
}

TEST(RunFolder, OneProcessAtATime) {
  const fs::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), line_spec(1), folder, {});
  const files::FolderLock lock(folder);
  EXPECT_NE(fake::message_of<InvalidInput>([&] { resume_run(fake::catalogue(), folder, 2, {}); }).find("in use"),
            std::string::npos);
}

}  // namespace
}  // namespace rehearse::experiment
