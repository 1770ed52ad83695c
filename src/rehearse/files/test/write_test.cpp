#include "rehearse/files/write.hpp"

#include <chrono>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/test/test_tools.hpp"

namespace rehearse::files {
namespace {

namespace fs = std::filesystem;

TEST(ExperimentFiles, AreReplacedAndTheirTemporariesAreNeverWrittenThrough) {
  const fs::path folder = test_folder(), file = folder / "table.csv", victim = folder / "victim";
  write_file(victim, "whole");
  fs::create_symlink(victim, folder / "table.csv.tmp");
  write_file(file, "one");
  EXPECT_EQ(read_file(file), "one");
  fs::create_symlink(folder / "nowhere", folder / "table.csv.tmp");
  write_file(file, "two");
  fs::create_hard_link(victim, folder / "table.csv.tmp");
  write_file(file, "three");
  ASSERT_EQ(::mkfifo((folder / "table.csv.tmp").c_str(), 0600), 0);
  write_file(file, "four");
  EXPECT_EQ(read_file(file), "four");
  EXPECT_EQ(read_file(victim), "whole");
  EXPECT_FALSE(fs::exists(folder / "nowhere"));
  EXPECT_FALSE(fs::exists(folder / "table.csv.tmp"));
}

TEST(ExperimentFiles, KeepTheirPermissions) {
  const fs::path file = test_folder() / "page.html";
  write_shared_file(file, "one");
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  write_shared_file(file, "two");
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(ExperimentFiles, ALinkInThePlaceOfAFileIsReplaced) {
  const fs::path folder = test_folder(), file = folder / "table.csv", victim = folder / "victim";
  write_file(victim, "whole");
  fs::create_symlink(victim, file);
  EXPECT_FALSE(holds(file, "whole"));
  write_file(file, "new");
  EXPECT_TRUE(holds(file, "new"));
  EXPECT_FALSE(holds(file, "old"));
  EXPECT_EQ(read_file(victim), "whole");
}

TEST(ExperimentFiles, ALockIsNoLink) {
  const fs::path folder = test_folder(), target = folder / "target";
  fs::create_symlink(target, folder / "lock");
  const auto refused = [&] { return message_of<InvalidInput>([&] { const FolderLock lock(folder); }); };
  EXPECT_EQ(refused(), "cannot write " + (folder / "lock").string() + ": it is a link");
  EXPECT_FALSE(fs::exists(target));
  fs::remove(folder / "lock");
  ASSERT_EQ(::mkfifo((folder / "lock").c_str(), 0600), 0);
  EXPECT_EQ(refused(), "cannot write " + (folder / "lock").string() + ": it is no regular file");
}

TEST(ExperimentFiles, WhoAsksForALockNeitherWaitsNorWrites) {
  const fs::path folder = test_folder();
  EXPECT_FALSE(FolderLock::is_held(folder));
  EXPECT_FALSE(fs::exists(folder / "lock"));
  {
    const FolderLock lock(folder);
    const auto before = std::chrono::steady_clock::now();
    EXPECT_TRUE(FolderLock::is_held(folder));
    EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::milliseconds(500));
  }
  EXPECT_FALSE(FolderLock::is_held(folder));
}

}  // namespace
}  // namespace rehearse::files
