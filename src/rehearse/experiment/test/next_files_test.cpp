#include "rehearse/experiment/next_files.hpp"

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/experiment/ask_tell.hpp"
#include "wrapped.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

/// Counts how often it is asked.
class Counting final : public fake::Wrapped {
 public:
  Counting(std::unique_ptr<learners::Learner> inner, int* asks) : Wrapped(std::move(inner)), asks_(asks) {}
  const learners::Proposal& ask() override { return ++*asks_, Wrapped::ask(); }

 private:
  int* asks_;
};

TEST(NextFiles, AreWrittenAgainWithoutTheLearner) {
  int asks = 0;
  const Catalogue counting =
      fake::catalogue_of([&](auto inner) { return std::make_unique<Counting>(std::move(inner), &asks); });
  const fs::path told = fake::test_folder() / "told";
  start_run(counting, fake::line_spec(0), told, {});
  const AskResult first = ask_run(counting, told, {});
  const std::string policy = files::read_file(told / "next/policy.json");
  fs::remove_all(told / "next");
  const AskResult again = ask_run(counting, told, {});
  EXPECT_EQ(asks, 1);
  EXPECT_EQ(again.trial.theta, first.trial.theta);
  EXPECT_EQ(files::read_file(again.folder / "policy.json"), policy);
}

}  // namespace
}  // namespace rehearse::experiment
