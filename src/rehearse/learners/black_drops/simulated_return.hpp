#pragma once
// The objective of a policy search, from simulated episodes.

#include <cstdint>
#include <vector>

#include "rehearse/learners/black_drops/search_problem.hpp"
#include "rehearse/rollout/gradient.hpp"

namespace rehearse::learners::black_drops {

/// A policy's mean return, and how many of its episodes broke each limit; these with SafetyOptions::caution.
struct Measurement {
  double mean = 0;
  std::vector<LimitRisk> risks;
  double early = 0;  // over all episodes, of 0 for one that kept the limits, from 1/2 for one that broke one in its
                     // last step to 1 for one that did in its first
};

/// The objective of a search: the mean return of simulated episodes, which end where they break a limit. In a
/// constrained search a policy that keeps the limits too rarely has a value below that of any policy of the batch that
/// keeps them, and the lower the more often and the earlier it breaks them (Deb 2000); all its episodes have
/// SafetyOptions::caution. It counts rollouts. References must outlive it.
class SimulatedReturn {
 public:
  SimulatedReturn(const SearchProblem& problem, const SearchOptions& options, StreamKey key)
      : problem_(problem), options_(options), key_(key) {}

  /// The objective as an optim::BatchObjective.
  void operator()(const ConstMatrixView& Theta, std::uint64_t first, Index samples, VectorView values);

  /// Values of each policy (parameters × policies), from so many evaluations.
  std::vector<Measurement> measure(const ConstMatrixView& Theta, std::uint64_t first, Index samples);

  /// Mean returns of policies (parameters × policies), so many rollouts of each that no call has had, and gradients.
  rollout::ReturnGradients gradients(const ConstMatrixView& Theta, Index particles);

  std::uint64_t next() const { return next_; }  // the first candidate that no call has had
  Index rollouts() const { return rollouts_; }
  Index failed() const { return failed_; }

 private:
  bool doubts_its_certainty() const;
  rollout::Simulated simulate(const ConstMatrixView& Theta, std::uint64_t first, Index episodes, double deviations);
  rollout::Simulated simulate_in_doubt(const ConstMatrixView& Theta, Index episodes) const;

  const SearchProblem& problem_;
  const SearchOptions& options_;
  StreamKey key_;
  std::uint64_t next_ = 0;
  Index rollouts_ = 0, failed_ = 0;
  Interval seen_{kInf, -kInf};  // mean returns
};

}  // namespace rehearse::learners::black_drops
