#include "rehearse/learners/ite/illumination.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/learners/ite/test/slider_setting.hpp"
#include "rehearse/learners/test/memory_store.hpp"
#include "rehearse/qd/archive_bytes.hpp"

namespace rehearse::learners::ite {
namespace {

TEST(Illumination, ComesFromTheStoreAndIsTheSame) {
  const auto store = std::make_shared<MemoryStore>();
  Setting with = setting();
  with.store = store;
  const std::string fresh = *builder()->build(setting())->ask().archive, first = *builder()->build(with)->ask().archive;
  EXPECT_EQ(first, fresh);
  EXPECT_EQ(store->kept.size(), 1U);
  EXPECT_EQ(store->writes, 1);
  std::vector<Progress> events;
  with.progress = [&](const Progress& p) { events.push_back(p); };
  EXPECT_EQ(*builder()->build(with)->ask().archive, first);
  EXPECT_EQ(store->writes, 1);
  EXPECT_TRUE(events.empty()) << "nothing was computed";
  builder({{"archive.evaluations", "2001"}})->build(with)->ask();
  EXPECT_EQ(store->writes, 2) << "another archive";
}

TEST(Illumination, MakesAgainWhatIsDamagedForeignOrStale) {
  const auto store = std::make_shared<MemoryStore>();
  Setting with = setting();
  with.store = store;
  const std::string good = *builder()->build(with)->ask().archive;
  std::string& kept = store->kept.begin()->second;
  Setting stale = setting(1.2);  // a simulator that changed without anybody saying so
  stale.store = store;
  builder()->build(stale)->ask();
  EXPECT_NE(kept, good);
  for (const std::string& bad : {std::string("foreign"), good.substr(0, good.size() / 2), std::string(kept)}) {
    kept = bad;
    EXPECT_EQ(*builder()->build(with)->ask().archive, good);
    EXPECT_EQ(kept, good);
  }
}

// 40 960 evaluations: kept every 16 384.
TEST(Illumination, GoesOnAfterAnInterruption) {
  const OptionTexts long_one{{"archive.evaluations", "40000"}};
  const std::string whole = *builder(long_one)->build(setting())->ask().archive;
  const auto store = std::make_shared<MemoryStore>();
  Setting with = setting();
  with.store = store;
  with.progress = [](const Progress& p) {
    if (p.phase == "archive" && p.rollouts > 20000) throw Interrupted();
  };
  const auto learner = builder(long_one)->build(with);
  EXPECT_THROW(learner->ask(), Interrupted);
  EXPECT_EQ(store->kept.size(), 1U) << "unfinished";
  Index least = 1 << 30;
  with.progress = [&](const Progress& p) { least = std::min(least, p.rollouts); };
  const Proposal resumed = builder(long_one)->build(with)->ask();
  EXPECT_GT(least, 16384);
  EXPECT_EQ(whole, *resumed.archive);
}

TEST(Illumination, CountsRolloutsThatFail) {
  Setting fragile = setting();
  const ParameterSpace space = fragile.prior->space;
  const auto breaks = [](double limit) {
    return [limit](const ConstMatrixView& X, const ConstMatrixView& U, const Vector&, MatrixView dX) {
      for (Index i = 0; i < X.rows(); ++i) dX(i, 0) = X(i, 0) < limit ? std::nan("") : 0.2 * U(i, 0);
    };
  };
  fragile.prior->simulator = system::make_simulator(space, breaks(0));
  const Proposal proposal = builder()->build(fragile)->ask();
  EXPECT_GT(proposal.failed_rollouts, 0);
  EXPECT_LT(proposal.failed_rollouts, proposal.rollouts);
  fragile.prior->simulator = system::make_simulator(space, breaks(10));
  try {
    builder()->build(fragile)->ask();
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "no archive: all 2048 rollouts in the prior failed");
  }
}

TEST(Illumination, TakesAnArchiveFromAFile) {
  const std::string made = *builder()->build(setting())->ask().archive;
  const std::string file = ::testing::TempDir() + "rehearse-archive.bin";
  std::ofstream(file, std::ios::binary) << made;
  const OptionTexts options{{"archive.file", file}};
  const Proposal proposal = builder(options)->build(setting(1, 2))->ask();
  EXPECT_EQ(*proposal.archive, made) << "whatever the seed";
  EXPECT_EQ(proposal.theta, builder()->build(setting())->ask().theta);

  const auto refused = [&](const Setting& with) -> std::string {
    try {
      builder(options)->build(with)->ask();
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return {};
  };
  Setting other = setting();
  other.task.descriptor_bounds.resize(1);
  EXPECT_EQ(refused(other),
            "archive.file = " + file + ": its descriptors have 2 numbers, must have 1 as the task's have");
  Setting larger = setting();
  larger.policy = policy::make_linear(
      {.features = larger.task.feature_map(), .scale = Vector::Ones(1), .squash = {{{-1, 1}, {-1, 1}}, 1}});
  EXPECT_NE(refused(larger).find("its policies have"), std::string::npos) << refused(larger);
  std::ofstream(file, std::ios::binary) << made.substr(0, made.size() / 2);
  EXPECT_EQ(refused(setting()).find("archive.file = " + file + ": "), 0U) << refused(setting());
  EXPECT_EQ(builder(options)->violations(setting().task, *setting().policy).size(), 1U) << "before anything runs";
  std::filesystem::remove(file);
  EXPECT_EQ(refused(setting()), "archive.file = " + file + ": it is not there");
}

TEST(Illumination, TakesTheFileOfTheRunsSeed) {
  const std::string files = ::testing::TempDir() + "rehearse-archive-";
  const auto with_files = builder({{"archive.file", files + "{seed}.bin"}});
  std::vector<std::string> made;
  for (const std::uint64_t seed : {1, 2}) {
    made.push_back(*builder()->build(setting(1, seed))->ask().archive);
    std::ofstream(files + std::to_string(seed) + ".bin", std::ios::binary) << made.back();
  }
  EXPECT_NE(made[0], made[1]) << "two seeds have two archives";
  EXPECT_TRUE(with_files->violations(setting().task, *setting().policy).empty());
  for (const std::uint64_t seed : {1, 2})
    EXPECT_EQ(*with_files->build(setting(1, seed))->ask().archive, made[seed - 1]);
  try {
    with_files->build(setting(1, 3));
    FAIL() << "before anything runs";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.what(), "archive.file = " + files + "3.bin: it is not there");
  }
  for (const char* seed : {"1", "2"}) std::filesystem::remove(files + seed + ".bin");
}

}  // namespace
}  // namespace rehearse::learners::ite
