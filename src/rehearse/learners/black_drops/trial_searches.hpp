#pragma once

#include <vector>

#include "rehearse/learners/black_drops/policy_search.hpp"

namespace rehearse::learners::black_drops {

/// The searches and comparisons of one trial, each with random numbers of its own. It counts their rollouts.
/// References must outlive it.
class TrialSearches {
 public:
  /// trial: seed, trial and phase of all random numbers. first: the number of the first search of each kind.
  TrialSearches(const SearchProblem& problem, const SearchOptions& options, const StreamKey& trial,
                std::uint64_t first = 0);

  /// The i-th search that simulates the model's uncertainty. Its first descents begin at `starts`.
  SearchResult search(const std::vector<Vector>& starts, Index i);

  /// The i-th search for policies that solve the task: an episode that does earns `bonus` more. The result's predicted
  /// return is without it. The task must have a test of success.
  SearchResult search_solving(const std::vector<Vector>& starts, double bonus, Index i);

  /// The i-th search near some policies for one that keeps the task's limits: each descent begins at one of them, and
  /// several rollouts are one evaluation, which tells how often a limit is broken.
  SearchResult search_safe(const std::vector<Vector>& starts, Index i);

  /// A policy's predicted return, and risks, under the model's uncertainty.
  SearchResult judge(const Vector& theta);

  /// The same in other episodes, which have decided nothing; of a task with limits also how surely it is solved.
  SearchResult judge_anew(const Vector& theta);

  /// True if the model's uncertainty changes a policy's predicted return by less than a thousandth.
  bool is_sure_of(const Vector& theta);

  /// The policy of a search that solves the task most often in simulated episodes, among those no less safe than its
  /// result; if none does under uncertainty, one that does in the mean predictions. Empty if none does, or if the task
  /// has no test of success.
  std::optional<SearchResult> best_that_solves(const SearchResult& found);

  /// How surely each policy solves the task, in episodes that decide nothing else; 0 if the task has no test of
  /// success.
  Vector compare_solving(const std::vector<Vector>& policies) { return solving(policies, 2); }

  bool has_limits() const { return !problem_.task.limits.empty(); }
  bool can_tell_solved() const { return static_cast<bool>(problem_.task.solved); }
  Index rollouts() const { return rollouts_; }
  Index failed_rollouts() const { return failed_rollouts_; }

 private:
  StreamKey key(Stage stage, Index search = 0) const;
  /// How surely each policy solves the task: its rate, and a little for the mean predictions.
  Vector solving(const std::vector<Vector>& policies, Index number);
  SearchResult counted(SearchResult found);

  const SearchProblem problem_;
  const SearchOptions& options_;
  const StreamKey trial_;
  const std::uint64_t first_;
  Index rollouts_ = 0, failed_rollouts_ = 0;
};

/// True if a policy's predicted return falls short of `expected` by no more than a fraction of it.
bool within(double tolerance, double expected, double predicted);

}  // namespace rehearse::learners::black_drops
