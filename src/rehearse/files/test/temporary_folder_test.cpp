#include "rehearse/files/temporary_folder.hpp"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/test/test_tools.hpp"
#include "rehearse/files/regular_file.hpp"

namespace rehearse::files {
namespace {

TEST(TemporaryFolder, HasFilesAndIsGoneWithItsObject) {
  std::filesystem::path path;
  {
    const TemporaryFolder folder, other;
    path = folder.path();
    EXPECT_NE(path, other.path());
    folder.add("a/b.txt", "text");
    EXPECT_EQ(read_file(path / "a/b.txt"), "text");
    EXPECT_NE(std::filesystem::status(path / "a/b.txt").permissions() & std::filesystem::perms::owner_exec,
              std::filesystem::perms::none);
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(TemporaryFolder, AllMayBeRemovedAtOnce) {
  const TemporaryFolder folder, other;
  folder.add("a.txt", "text");
  remove_temporary_folders();
  EXPECT_FALSE(std::filesystem::exists(folder.path()));
  EXPECT_FALSE(std::filesystem::exists(other.path()));
}

TEST(TemporaryFolder, NeedsAFolderForTemporaryFiles) {
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  ::setenv("TMPDIR", "/no/such/folder", 1);
  EXPECT_EQ(message_of<InvalidInput>([] { const TemporaryFolder folder; }),
            "TMPDIR = '/no/such/folder', must be a folder in which files can be made");
  before ? ::setenv("TMPDIR", kept.c_str(), 1) : ::unsetenv("TMPDIR");
}

TEST(TemporaryFolder, NothingIsWrittenOutsideOfIt) {
  const TemporaryFolder folder;
  for (const char* out : {"", "/tmp/x", "../x", "a/../../x"}) EXPECT_THROW(folder.add(out, ""), InvalidInput) << out;
  EXPECT_TRUE(stays_within("./a/b"));
}

}  // namespace
}  // namespace rehearse::files
