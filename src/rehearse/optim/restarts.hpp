#pragma once
// Global search: descents of CMA-ES one after the other.

#include <string>
#include <vector>

#include "rehearse/optim/cmaes.hpp"
#include "rehearse/optim/objective.hpp"
#include "rehearse/optim/uncertainty.hpp"

namespace rehearse::optim {

enum class Strategy {
  single,  // one descent
  ipop,    // each restart with twice the population, Auger and Hansen 2005
  bipop,   // these interlaced with small populations and small steps, Hansen 2009 (BBOB-2009 function testbed)
};

struct SearchOptions {
  Strategy strategy = Strategy::bipop;
  Index max_evaluations = 100000;  // of all descents together; evaluating a candidate twice counts twice
  double step = 0.2;               // first σ of a descent, as a fraction of the box's width; Hansen 2009
  double start_step = 0;           // the same for the descent from the given start; 0: step
  Index max_doublings = 9;         // of the population; Hansen 2009
  double target = kInf;            // stop at this value
  Index candidates = 4;            // of the best points, and as many of the means, go into the result
  bool means_alone = false;  // no best points: with noise these are the luckiest (libcmaes with uncertainty handling)
  Index final_samples = 0;   // evaluations of each of these at the end, to choose by; 0: chosen as they were seen
  Index reserved() const { return 2 * candidates * final_samples; }  // evaluations for that
  CmaesOptions cmaes{};  // its population is the smallest; its step tolerance a fraction of `step`
  UncertaintyOptions uncertainty{};
  void fields(FieldVisitor& v);
};

/// One descent, as it ended.
struct Descent {
  Index population = 0;
  double step = 0;  // first σ, as a fraction of the box's width
  Index evaluations = 0;
  Index generations = 0;
  double best_value = 0;
  double mean_value = 0;  // of one evaluation of the distribution's mean
  std::string stop;
};

/// A point that might be the best.
struct Candidate {
  Vector x;
  double value = 0;
  Index descent = 0;
  bool mean = false;  // of a descent's distribution; else the best point that it saw
};

struct SearchResult {
  Vector x;  // the first of the candidates; the start as long as no value was finite
  double value = 0;
  Index evaluations = 0;
  std::string stop;  // why, in words
  std::vector<Descent> descents;
  std::vector<Candidate> candidates;  // best first; with noise, best seen values are too good: evaluate these again
};

/// Searches the box, first from `start`, later from points uniform in it. Coordinates are scaled by the box's widths.
/// Random numbers come from `key`, whose descent, candidate and particle must be 0. Throws InvalidInput with every
/// violation.
SearchResult maximise(const BatchObjective& objective, const Vector& start, const std::vector<Interval>& box,
                      const SearchOptions& options, const StreamKey& key, const SearchListener& listener = {});

}  // namespace rehearse::optim
