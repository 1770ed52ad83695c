#include "rehearse/testing/check_learner.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
#include "rehearse/testing/compare.hpp"

namespace rehearse::testing {
namespace {

using learners::Learner;
using learners::Proposal;

/// The record of a run of a learner.
struct Run {
  std::vector<Proposal> proposals;  // of trials 1, 2, …
  std::vector<Episode> episodes;
  std::vector<std::string> saved;                    // after 0, 1, … episodes
  std::vector<std::vector<learners::Table>> tables;  // after 1, 2, …
};

template <class T>
bool same_optional(const std::optional<T>& a, const std::optional<T>& b) {
  return a.has_value() == b.has_value() && (!a || same(*a, *b));
}

std::string name_of(const Proposal& proposal) { return proposal.policy ? proposal.policy->name() : ""; }

std::optional<Matrix> covariance(const Proposal& proposal) {
  return proposal.posterior ? std::optional(proposal.posterior->covariance) : std::nullopt;
}

/// Names of what differs; the model is compared by what it predicted, times not at all.
std::string difference(const Proposal& a, const Proposal& b) {
  std::string names;
  const auto compare = [&](bool equal, const char* name) {
    if (!equal) names += (names.empty() ? "" : ", ") + std::string(name);
  };
  compare(name_of(a) == name_of(b), "policy");
  compare(same(a.theta, b.theta), "theta");
  compare(same_optional(a.predicted_return, b.predicted_return), "predicted_return");
  compare(same_optional(a.log_evidence, b.log_evidence), "log_evidence");
  compare(same_optional(a.phi, b.phi), "phi");
  compare(same_optional(covariance(a), covariance(b)), "the covariance of phi");
  compare(a.rollouts == b.rollouts, "rollouts");
  compare(a.failed_rollouts == b.failed_rollouts, "failed_rollouts");
  compare(a.left_out_rows == b.left_out_rows, "left_out_rows");
  compare(a.notes == b.notes, "notes");
  return names;
}

bool same_tables(const std::vector<learners::Table>& a, const std::vector<learners::Table>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    return one.name == other.name && one.columns == other.columns && same(one.rows, other.rows);
  });
}

class LearnerCheck {
 public:
  LearnerCheck(const learners::LearnerBuilder& builder, const learners::Setting& setting, const RunTrial& run_trial,
               Index trials)
      : builder_(builder), setting_(setting), run_trial_(run_trial), trials_(trials) {}

  std::vector<std::string> run() {
    const Run one = run_from_start(1), two = run_from_start(2);
    for (std::size_t k = 0; k < one.proposals.size(); ++k) {
      const std::string names = difference(one.proposals[k], two.proposals[k]);
      found_.require(names.empty(), fmt::format("trial {}: two threads give another {}", k + 1, names));
      found_.require(same_tables(one.tables[k], two.tables[k]),
                     fmt::format("trial {}: two threads give other tables", k + 1));
    }
    for (Index told = 0; told < trials_; ++told) check_loaded(one, told);
    for (Index told = 0; told + 1 < trials_; ++told) check_asked_again(one, told);
    check_logs(one);
    return found_.list();
  }

 private:
  std::unique_ptr<Learner> build(int threads) const {
    learners::Setting setting = setting_;
    setting.evaluator = make_thread_evaluator(threads);
    return builder_.build(std::move(setting));
  }

  Run run_from_start(int threads) {
    const auto learner = build(threads);
    Run run;
    run.saved.push_back(learner->save().dump());
    for (Index k = 1; k <= trials_; ++k) {
      run.proposals.push_back(learner->ask());
      check_policy_of(run.proposals.back(), k);
      const std::string names = difference(run.proposals.back(), learner->ask());
      found_.require(names.empty(), fmt::format("trial {}: asked again, another {} is proposed", k, names));
      run.episodes.push_back(run_trial_(run.proposals.back(), static_cast<std::uint64_t>(k)));
      learner->tell(run.episodes.back());
      run.saved.push_back(learner->save().dump());
      run.tables.push_back(learner->tables());
      check_tables(run.tables.back(), k);
    }
    return run;
  }

  void check_policy_of(const Proposal& proposal, Index trial) {
    const Index wanted = proposal.policy ? proposal.policy->parameters() : 0;
    found_.require(proposal.policy != nullptr, fmt::format("trial {}: a proposal without a policy", trial));
    found_.require(!proposal.policy || proposal.theta.size() == wanted,
                   fmt::format("trial {}: {} parameters, the policy takes {}", trial, proposal.theta.size(), wanted));
  }

  void check_tables(const std::vector<learners::Table>& tables, Index trial) {
    for (const learners::Table& table : tables)
      found_.require(table.rows.cols() == static_cast<Index>(table.columns.size()),
                     fmt::format("trial {}: table {} has {} columns and names of {}", trial, table.name,
                                 table.rows.cols(), table.columns.size()));
  }

  /// Checks that a learner loaded after `told` episodes goes on the same way, to the end.
  void check_loaded(const Run& run, Index told) {
    const auto first = static_cast<std::size_t>(told);
    const auto learner = build(1);
    learner->load({run.episodes.begin(), run.episodes.begin() + told}, nlohmann::json::parse(run.saved[first]));
    found_.require(learner->save().dump() == run.saved[first],
                   fmt::format("loaded after {} episodes, something else is saved", told));
    found_.require(told == 0 || same_tables(run.tables[first - 1], learner->tables()),
                   fmt::format("loaded after {} episodes, it has other tables", told));
    for (std::size_t k = first; k < run.proposals.size(); ++k) {
      const std::string names = difference(run.proposals[k], learner->ask());
      if (!names.empty())
        return found_.add(fmt::format("loaded after {} episodes, trial {} has another {}", told, k + 1, names));
      learner->tell(run.episodes[k]);
      if (!same_tables(run.tables[k], learner->tables()))
        return found_.add(fmt::format("loaded after {} episodes, other tables after trial {}", told, k + 1));
    }
  }

  /// Checks that a learner given the θ of a trial by `ask_again` goes on the same way.
  void check_asked_again(const Run& run, Index told) {
    const auto k = static_cast<std::size_t>(told);
    const auto learner = build(1);
    learner->load({run.episodes.begin(), run.episodes.begin() + told}, nlohmann::json::parse(run.saved[k]));
    const Proposal again = learner->ask_again({name_of(run.proposals[k]), run.proposals[k].theta});
    found_.require(name_of(again) == name_of(run.proposals[k]) && same(again.theta, run.proposals[k].theta),
                   fmt::format("trial {}: with θ given, another policy is proposed", told + 1));
    learner->tell(run.episodes[k]);
    found_.require(learner->save().dump() == run.saved[k + 1],
                   fmt::format("trial {}: with θ given, something else is saved after it", told + 1));
    const std::string names = difference(run.proposals[k + 1], learner->ask());
    found_.require(names.empty(),
                   fmt::format("trial {}: with θ given, trial {} has another {}", told + 1, told + 2, names));
  }

  /// The first episode is a log for two learners, one of which is told the second and one of which loads it.
  void check_logs(const Run& run) {
    if (run.episodes.size() < 2) return;
    const std::vector<Episode> logs = {run.episodes[0]}, told = {run.episodes[1]};
    const auto one = build(1), other = build(2);
    try {
      one->study(logs);
    } catch (const InvalidInput&) {
      return;  // it learns from its own policies alone
    }
    other->study(logs);
    one->ask();
    one->tell(told[0]);
    other->load(told, nlohmann::json::parse(one->save().dump()));
    const std::string names = difference(one->ask(), other->ask());
    found_.require(names.empty(), fmt::format("loaded after a log and an episode, trial 2 has another {}", names));
  }

  const learners::LearnerBuilder& builder_;
  learners::Setting setting_;
  RunTrial run_trial_;
  Index trials_;
  Violations found_;
};

}  // namespace

std::vector<std::string> check_learner(const learners::LearnerBuilder& builder, const learners::Setting& setting,
                                       const RunTrial& run_trial, Index trials) {
  return LearnerCheck(builder, setting, run_trial, trials).run();
}

}  // namespace rehearse::testing
