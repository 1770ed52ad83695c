#include "rehearse/experiment/folder_cache.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "rehearse/experiment/files.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

class FolderCacheTest : public ::testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_ = fs::temp_directory_path() / ("rehearse-cache-" + std::to_string(::getpid()));
  FolderCache cache_{folder_ / "deep"};
};

TEST_F(FolderCacheTest, GivesBackWhatItWasGiven) {
  const std::string bytes("a\0b\n", 4);
  EXPECT_FALSE(cache_.read("key"));
  EXPECT_FALSE(fs::exists(folder_)) << "reading makes no folder";
  cache_.write("key", "old");
  cache_.write("key", bytes);
  cache_.write("other\nkey", "");
  EXPECT_EQ(cache_.read("key"), bytes);
  EXPECT_EQ(cache_.read("other\nkey"), "");
  EXPECT_FALSE(cache_.read("third"));
  cache_.remove("key");
  cache_.remove("key");
  EXPECT_FALSE(cache_.read("key"));
}

TEST_F(FolderCacheTest, AnEntryOfAnotherKeyIsNone) {
  cache_.write("key", "bytes");
  const fs::path file = fs::directory_iterator(folder_ / "deep")->path();
  for (const char* foreign : {"3\nkexbytes", "4\nkeybytes", "", "3\nke"}) {
    std::ofstream(file, std::ios::trunc) << foreign;
    EXPECT_FALSE(cache_.read("key")) << foreign;
  }
}

TEST_F(FolderCacheTest, AFolderThatCannotBeMadeIsAnEmptyOne) {
  std::ofstream(folder_) << "a file where the folder should be";
  cache_.write("key", "bytes");
  EXPECT_FALSE(cache_.read("key"));
}

}  // namespace
}  // namespace rehearse::experiment
