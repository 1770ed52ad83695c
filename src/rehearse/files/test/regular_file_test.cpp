#include "rehearse/files/regular_file.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::files {
namespace {

namespace fs = std::filesystem;

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / ("files-" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "file", std::ios::binary) << std::string("two\0lines\n", 10);
    fs::create_symlink("file", folder_ / "link");
    fs::create_symlink("nowhere", folder_ / "dangling");
    ASSERT_EQ(::mkfifo((folder_ / "fifo").c_str(), 0600), 0);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string why(const std::string& name, Links links = Links::refuse) const {
    try {
      read_file(folder_ / name, links);
    } catch (const InvalidInput& error) {
      return std::string(error.what()).substr(std::string("cannot read ").size() + (folder_ / name).string().size());
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(Files, AreReadWhole) {
  EXPECT_EQ(read_file(folder_ / "file"), std::string("two\0lines\n", 10));
  const std::string large(200000, 'x');
  std::ofstream(folder_ / "large") << large;
  EXPECT_EQ(read_file(folder_ / "large"), large);
  EXPECT_GT(read_file("/proc/self/exe", Links::follow).size(), 1000u);
}

TEST_F(Files, NothingButARegularFileIsOpened) {
  EXPECT_EQ(why("file"), "");
  EXPECT_EQ(why("nothing"), ": it is not there");
  EXPECT_EQ(why("fifo"), ": it is no regular file");
  EXPECT_EQ(why("."), ": it is no regular file");
  EXPECT_EQ(why("link"), ": it is a link");
  EXPECT_EQ(why("dangling"), ": it is a link");
  EXPECT_EQ(why("link", Links::follow), "");
  EXPECT_EQ(why("dangling", Links::follow), ": it is not there");
}

TEST_F(Files, NoLinkIsWrittenThrough) {
  const RegularFile link(folder_ / "link", O_WRONLY | O_TRUNC), dangling(folder_ / "dangling", O_WRONLY | O_CREAT);
  EXPECT_FALSE(link.open());
  EXPECT_FALSE(dangling.open());
  EXPECT_EQ(fs::file_size(folder_ / "file"), 10u);
  EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

TEST_F(Files, KnowTheirLastByte) {
  EXPECT_TRUE(RegularFile(folder_ / "file").ends_with('\n'));
  EXPECT_FALSE(RegularFile(folder_ / "file").ends_with('s'));
  std::ofstream(folder_ / "empty").flush();
  EXPECT_FALSE(RegularFile(folder_ / "empty").ends_with('\n'));
  EXPECT_FALSE(RegularFile(folder_ / "fifo").ends_with('\n'));
}

}  // namespace
}  // namespace rehearse::files
