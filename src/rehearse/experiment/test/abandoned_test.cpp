#include "rehearse/experiment/abandoned.hpp"

#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fake.hpp"
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
  fs::path hidden = folder / fmt::format(".{}.{}", name, process);
  fs::create_directories(hidden / "trajectories");
  std::ofstream(hidden / "spec.toml.tmp") << "half";
  return hidden;
}

TEST(Abandoned, FoldersOfDeadProcessesGo) {
  const fs::path folder = fake::test_folder();
  const pid_t dead = dead_process();
  const fs::path same = begun(folder, "run", dead);
  const fs::path empty = folder / fmt::format(".run.{}", dead_process());
  fs::create_directory(empty);
  remove_abandoned(folder / "run");
  for (const fs::path& gone : {same, empty}) EXPECT_FALSE(fs::exists(gone)) << gone;
}

TEST(Abandoned, WhatMayBeSomebodysStays) {
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
  remove_abandoned(folder / "run");
  for (const fs::path& kept : {alive, theirs, trials, locked, of_another_machine, target / "trajectories", link})
    EXPECT_TRUE(fs::exists(kept)) << kept;
}

}  // namespace
}  // namespace rehearse::experiment
