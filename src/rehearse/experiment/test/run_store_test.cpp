#include "rehearse/experiment/run_store.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "fake.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/run_options.hpp"
#include "rehearse/experiment/spec_file.hpp"
#include "rehearse/files/seal.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

Spec spec(Index seed = 1, Index trials = 10) {
  return {.scenario = "line", .learner = "echo", .trials = trials, .seed = seed};
}

RunStore store(const fs::path& run, const Spec& spec, const fs::path& cache = {}) {
  RunStore store(spec, [cache] { return cache; });
  if (!run.empty()) store.open(run);
  return store;
}

TEST(RunStore, KeepsBytesInTheRunFolder) {
  const fs::path run = fake::test_folder();
  const std::string bytes("two\0lines\n", 10);
  EXPECT_FALSE(store(run, spec()).read("prior"));
  store(run, spec()).write("prior", bytes);
  EXPECT_EQ(store(run, spec()).read("prior"), bytes);
  EXPECT_EQ(store(run, spec(1, 20)).read("prior"), bytes) << "of a run of more trials";
  EXPECT_FALSE(store(run, spec(2)).read("prior")) << "of another spec";
  EXPECT_FALSE(store(run, spec()).read("archive"));
  store(run, spec()).write("prior", "");
  EXPECT_EQ(store(run, spec()).read("prior"), "");
  EXPECT_TRUE(fs::exists(run / "kept" / "prior"));
}

TEST(RunStore, SharesByTheCache) {
  const fs::path folder = fake::test_folder(), cache = folder / "not" / "yet";
  for (const char* run : {"a", "b", "c"}) fs::create_directories(folder / run);
  store(folder / "a", spec(), cache).write("prior", "learned");
  EXPECT_EQ(store(folder / "b", spec(1, 3), cache).read("prior"), "learned");
  EXPECT_FALSE(store(folder / "b", spec(2), cache).read("prior"));
  EXPECT_FALSE(store(folder / "b", spec()).read("prior")) << "without the cache";
  store(folder / "c", spec()).write("prior", "its own");
  EXPECT_EQ(store(folder / "c", spec(), cache).read("prior"), "its own") << "the run folder comes first";
}

TEST(RunStore, DamagedFilesCountAsNone) {
  const fs::path folder = fake::test_folder(), cache = folder / "cache", run = folder / "run";
  fs::create_directories(run);
  store(run, spec(), cache).write("prior", "learned");
  const fs::path kept = run / "kept" / "prior";
  std::string bytes = files::read_file(kept);
  bytes.back() ^= 1;
  std::ofstream(kept, std::ios::binary) << bytes;
  EXPECT_FALSE(store(run, spec()).read("prior"));
  EXPECT_EQ(store(run, spec(), cache).read("prior"), "learned");
}

TEST(RunStore, DoesNotDependOnItsCache) {
  const fs::path folder = fake::test_folder(), run = folder / "run", file = folder / "file";
  fs::create_directories(run);
  std::ofstream(file) << "not a folder";
  store(run, spec(), file / "below").write("prior", "learned");
  EXPECT_EQ(store(run, spec(), file / "below").read("prior"), "learned");
  RunStore without(spec(), {});
  without.open(run);
  EXPECT_EQ(without.read("prior"), "learned");
  store({}, spec(), file / "below").write("prior", "nowhere");
  const fs::path none = folder / std::string(300, 'x');  // no file system has such a name
  store(run, spec(), none).write("prior", "learned");
  EXPECT_FALSE(store({}, spec(), none).read("prior"));
}

TEST(RunStore, ADiskThatFailsIsNotTheLearnersFault) {
  const fs::path run = fake::test_folder();
  std::ofstream(run / "kept") << "not a folder";
  try {
    store(run, spec()).write("archive", "of hours");
    FAIL() << "it was written";
  } catch (const RunFailed& error) {
    EXPECT_TRUE(error.resume_may_help());
  }
}

TEST(RunStore, KeepsForWhateverEnd) {
  const fs::path run = fake::test_folder();
  Spec until_solved = spec(1, 3);
  until_solved.until_solved = true;
  store(run, until_solved).write("archive", "of hours");
  EXPECT_EQ(store(run, spec()).read("archive"), "of hours");
  Spec older = until_solved.without_end();
  older.until_solved = true;
  files::write_file(run / "kept" / "prior", files::seal("kept", to_toml(older) + '\0' + "of an older version"));
  EXPECT_EQ(store(run, until_solved).read("prior"), "of an older version");
}

}  // namespace
}  // namespace rehearse::experiment
