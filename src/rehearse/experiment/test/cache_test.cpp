#include "rehearse/experiment/cache.hpp"

#include <chrono>
#include <fstream>

#include <gtest/gtest.h>

#include "fake.hpp"
#include "rehearse/experiment/run_store.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

/// hours: its age.
fs::path write(const fs::path& path, std::size_t bytes, int hours) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << std::string(bytes, 'x');
  fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(hours));
  return path;
}

TEST(Cache, TheOldestGoFirstInAllFolders) {
  const fs::path root = fake::test_folder(), one = cache_folder_of(root, 1), two = cache_folder_of(root, 2);
  const fs::path old = write(one / cache_entry("archive", 7), 100, 5),
                 older = write(two / cache_entry("prior", 7), 100, 6),
                 left = write(two / (cache_entry("prior", 8) + ".0123456789abcdef.tmp"), 100, 7),
                 young = write(one / cache_entry("archive", 9), 100, 1);
  EXPECT_EQ(cache_folders(root).size(), 2u);
  prune_cache(cache_folders(root), 400);
  EXPECT_TRUE(fs::exists(left));
  prune_cache(cache_folders(root), 250);
  EXPECT_FALSE(fs::exists(left));
  EXPECT_FALSE(fs::exists(older));
  EXPECT_TRUE(fs::exists(old));
  prune_cache({one}, 0);
  EXPECT_FALSE(fs::exists(young));
  prune_cache({root / "nowhere"}, 0);
}

TEST(Cache, WhatIsNotKeptByAStoreStays) {
  const fs::path root = fake::test_folder(), own = cache_folder_of(root, 1);
  std::vector<fs::path> others;
  for (const char* name : {"letter", "archive-12", "archive-0123456789abcdeg", "-0123456789abcdef",
                           "archive-0123456789abcdef.tmp", "archive-0123456789abcdef.txt"})
    others.push_back(write(own / name, 100, 9));
  others.push_back(write(root / "photos" / cache_entry("archive", 1), 100, 9));
  fs::create_symlink(others.front(), own / cache_entry("link", 1));
  prune_cache(cache_folders(root), 0);
  for (const fs::path& other : others) EXPECT_TRUE(fs::exists(other)) << other;
  EXPECT_TRUE(fs::is_symlink(own / cache_entry("link", 1)));
}

TEST(Cache, AStoresEntriesAreKnown) {
  const fs::path cache = fake::test_folder() / "cache";
  RunStore store({.scenario = "line", .learner = "echo"}, [&] { return cache; });
  store.write("prior", "learned");
  EXPECT_EQ(store.read("prior"), "learned") << "far below the bound";
  prune_cache({cache}, 0);
  EXPECT_FALSE(store.read("prior"));
}

}  // namespace
}  // namespace rehearse::experiment
