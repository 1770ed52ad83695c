#include "rehearse/experiment/unborn.hpp"

#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fake.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

/// The number of a process that has ended.
pid_t dead_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

fs::path begun(const fs::path& folder, const std::string& name, pid_t process) {
  fs::path unborn = folder / fmt::format(".{}.{}", name, process);
  fs::create_directories(unborn / "trajectories");
  std::ofstream(unborn / "spec.toml.tmp") << "half";
  return unborn;
}

TEST(Unborn, HasAName) {
  EXPECT_EQ(name_of_unborn(".run.12"), "run");
  EXPECT_EQ(name_of_unborn(".a.b-1.12"), "a.b-1");
  for (const char* other : {"run.12", ".run", ".run.", ".run.x", ".run.1x", "..12", ".12", ""})
    EXPECT_FALSE(name_of_unborn(other)) << other;
}

TEST(Unborn, OnesOfDeadProcessesGo) {
  const fs::path folder = fake::test_folder();
  const pid_t dead = dead_process();
  const fs::path same = begun(folder, "run", dead);
  const fs::path empty = folder / fmt::format(".run.{}", dead_process());
  fs::create_directory(empty);
  const fs::path unborn = make_unborn(folder / "run");
  EXPECT_TRUE(fs::is_directory(unborn / "predictions"));
  for (const fs::path& gone : {same, empty}) EXPECT_FALSE(fs::exists(gone)) << gone;
}

TEST(Unborn, WhatMayBeSomebodysStays) {
  const fs::path folder = fake::test_folder();
  const fs::path alive = begun(folder, "run", ::getppid()), theirs = begun(folder, "run", dead_process()),
                 trials = begun(folder, "run", dead_process()), locked = begun(folder, "run", dead_process()),
                 of_another_machine = begun(folder, "other", dead_process()), target = folder / "target",
                 link = folder / fmt::format(".run.{}", dead_process());
  std::ofstream(theirs / "letter") << "dear";
  std::ofstream(trials / "trajectories" / "trial-001.csv") << "time";
  fs::create_directories(target / "trajectories");
  fs::create_directory_symlink(target, link);
  const files::FolderLock lock(locked);
  make_unborn(folder / "run");
  for (const fs::path& kept : {alive, theirs, trials, locked, of_another_machine, target / "trajectories", link})
    EXPECT_TRUE(fs::exists(kept)) << kept;
}

TEST(Unborn, NeedsAFolderAroundIt) {
  const fs::path folder = fake::test_folder();
  std::ofstream(folder / "file") << "no folder";
  EXPECT_NE(fake::message_of<InvalidInput>([&] { make_unborn(folder / "file" / "run"); }).find("cannot create"),
            std::string::npos);
}

}  // namespace
}  // namespace rehearse::experiment
