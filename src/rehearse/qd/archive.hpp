#pragma once

#include <cstdint>
#include <vector>

#include "rehearse/core/types.hpp"
#include "rehearse/qd/niches.hpp"

namespace rehearse::qd {

struct Statistics {
  Index filled = 0;     // niches
  double coverage = 0;  // filled / all
  double qd_score = 0;  // Σ over filled niches of (performance − floor); empty niches add nothing
  double best = 0;      // performance; −∞ of an empty archive
  double mean = 0;      // over filled niches; NaN of an empty archive
};

/// The best solution found of each niche: its elite. A value.
class Archive {
 public:
  /// parameters: of a solution, P ≥ 1. Throws InvalidInput.
  Archive(Niches niches, Index parameters);

  const Niches& niches() const { return niches_; }
  Index parameters() const { return solutions_.rows(); }

  /// Keeps the solution (P numbers, `stride` apart) if it performs better than the elite of `niche`, or is its first.
  /// A niche of −1 or a performance that is not finite is never kept. Returns whether it was.
  bool add(Index niche, double performance, const double* descriptor, const double* solution, Index stride = 1);

  /// Elites are numbered in the order in which their niches were first filled.
  Index size() const { return static_cast<Index>(filled_.size()); }
  Index niche(Index elite) const { return filled_[static_cast<std::size_t>(elite)]; }
  double performance(Index elite) const { return performances_(elite); }
  auto descriptor(Index elite) const { return descriptors_.col(elite); }  // D, as it was told
  auto solution(Index elite) const { return solutions_.col(elite); }      // P

  /// −1: the niche is empty.
  Index elite_of(Index niche) const { return elites_[static_cast<std::size_t>(niche)]; }
  /// The elite of the highest performance, of several the first; −1 if there is none.
  Index best() const;

  /// floor: the lowest performance that there can be, so that each niche that is filled adds to the QD score.
  Statistics statistics(double floor = 0) const;

 private:
  void grow();

  Niches niches_;
  std::vector<std::int32_t> elites_;  // of each niche
  std::vector<Index> filled_;
  Vector performances_;             // one an elite, like the columns of
  Matrix descriptors_, solutions_;  // D and P × capacity
};

}  // namespace rehearse::qd
