#include "rehearse/testing/check_learner.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/random.hpp"
#include "rehearse/policy/schedule.hpp"
#include "small_task.hpp"

namespace rehearse::testing {
namespace {

enum class LearnerFault {
  none,
  asks_anew,
  counts_threads,
  forgets,
  no_policy,
  wrong_size,
  other_tables,
  unnamed_columns
};

/// Proposes the sum of all returns and a number of tells that only `save` keeps.
class Adding final : public learners::Learner {
 public:
  Adding(learners::Setting setting, LearnerFault fault) : setting_(std::move(setting)), fault_(fault) {}

  const learners::Proposal& ask() override {
    if (fault_ == LearnerFault::asks_anew) ++extra_;
    const double threads = fault_ == LearnerFault::counts_threads ? setting_.evaluator->concurrency() : 0;
    if (fault_ != LearnerFault::no_policy) proposal_.policy = policy::make_schedule({{0, 1}}, 1, 2);
    proposal_.theta = Vector{{sum_ + extra_ + threads, tells_}};
    if (fault_ == LearnerFault::wrong_size) proposal_.theta.conservativeResize(1);
    return proposal_;
  }
  void tell(const Episode& episode) override {
    sum_ += episode.total_reward();
    ++tells_;
    ++since_built_;
  }
  std::vector<learners::Table> tables() override {
    const double since_built = fault_ == LearnerFault::other_tables ? since_built_ : 0;
    learners::Table table{"sums", {"sum", "since built"}, Matrix{{sum_, since_built}}};
    if (fault_ == LearnerFault::unnamed_columns) table.columns.pop_back();
    return {table};
  }
  nlohmann::json save() const override { return {{"tells", tells_}}; }
  void load(const std::vector<Episode>& episodes, const nlohmann::json& state) override {
    for (const Episode& episode : episodes) sum_ += episode.total_reward();
    if (fault_ != LearnerFault::forgets) tells_ = state.at("tells").get<double>();
  }

 private:
  learners::Setting setting_;
  LearnerFault fault_;
  learners::Proposal proposal_;
  double sum_ = 0, tells_ = 0, extra_ = 0, since_built_ = 0;
};

class AddingBuilder final : public learners::LearnerBuilder {
 public:
  explicit AddingBuilder(LearnerFault fault) : fault_(fault) {}
  std::string name() const override { return "adding"; }
  std::string summary() const override { return "adds"; }
  learners::PriorUse prior_use() const override { return learners::PriorUse::none; }
  bool chooses_priors() const override { return false; }
  void fields(FieldVisitor&) override {}
  std::unique_ptr<learners::Learner> build(learners::Setting setting) const override {
    return std::make_unique<Adding>(std::move(setting), fault_);
  }

 private:
  LearnerFault fault_;
};

Episode run_trial(const learners::Proposal& proposal, std::uint64_t trial) {
  return {.states = Matrix::Zero(2, 1),
          .true_states = Matrix::Zero(2, 1),
          .actions = Matrix::Zero(1, 1),
          .rewards = Vector{{0.1 * static_cast<double>(trial) + 0.01 * proposal.theta(0)}}};
}

std::string check_adding(LearnerFault fault) { return joined(check_learner(AddingBuilder(fault), {}, run_trial)); }

TEST(CheckLearner, AcceptsAGoodOne) { EXPECT_EQ(check_adding(LearnerFault::none), ""); }

TEST(CheckLearner, FindsFaults) {
  EXPECT_NE(check_adding(LearnerFault::asks_anew).find("trial 1: asked again, another theta is proposed"),
            std::string::npos);
  EXPECT_NE(check_adding(LearnerFault::counts_threads).find("trial 1: two threads give another theta"),
            std::string::npos);
  EXPECT_NE(check_adding(LearnerFault::no_policy).find("trial 1: a proposal without a policy"), std::string::npos);
  EXPECT_NE(check_adding(LearnerFault::wrong_size).find("trial 1: 1 parameters, the policy takes 2"),
            std::string::npos);
  EXPECT_NE(check_adding(LearnerFault::forgets).find("loaded after 1 episodes, trial 2 has another theta"),
            std::string::npos);
  EXPECT_NE(check_adding(LearnerFault::other_tables).find("loaded after 1 episodes, other tables after trial 2"),
            std::string::npos);
  EXPECT_NE(check_adding(LearnerFault::unnamed_columns).find("trial 1: table sums has 2 columns and names of 1"),
            std::string::npos);
}

}  // namespace
}  // namespace rehearse::testing
