#include "rehearse/robot_file/kept_files.hpp"

#include <gtest/gtest.h>

namespace rehearse::robot_file {
namespace {

TEST(KeptFiles, AreReadOnceAndStayInTheirFolder) {
  int reads = 0;
  const scenario::ReadFile folder = [&](const std::string& path) -> std::optional<std::string> {
    ++reads;
    if (path == "a.py") return "text";
    return std::nullopt;
  };
  std::vector<scenario::NamedFile> files;
  KeptFiles kept(files, folder);
  EXPECT_TRUE(kept.keep("a.py"));
  EXPECT_TRUE(kept.keep("a.py"));
  EXPECT_EQ(reads, 1);
  EXPECT_FALSE(kept.keep("b.py"));
  EXPECT_FALSE(kept.keep("../a.py"));
  EXPECT_FALSE(kept.keep("/a.py"));
  EXPECT_EQ(reads, 2) << "nobody looks outside";
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files.front().bytes, "text");
}

}  // namespace
}  // namespace rehearse::robot_file
