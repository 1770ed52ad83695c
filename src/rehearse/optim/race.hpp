#pragma once
// Many short descents that compete: in each round the better ones go on and the others stop (successive halving,
// Karnin 2013). On a function with several families of solutions this finds the better family with fewer
// evaluations than restarts one after the other, and its generations make large batches.

#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/optim/cmaes.hpp"
#include "rehearse/optim/objective.hpp"

namespace rehearse::optim {

struct RaceOptions {
  Index descents = 16;       // that start; the first from the given start, the others uniform in the box
  double survivors = 0.5;    // fraction that goes on to the next round
  Index rounds = 4;          // of equal numbers of evaluations; in the last one `finalists` are left
  Index max_evaluations = 200000;
  double sigma = 1;          // first step size of a descent
  double start_sigma = 0.5;  // of the descent from the given start
  Index population = 34;
  CmaesOptions cmaes;
  void fields(FieldVisitor& v);
};

/// One descent's end.
struct Contender {
  Vector x;          // its best point
  double value = 0;  // the best value seen there
  Vector mean;       // where its search distribution is
  Index evaluations = 0;
  Index round = 0;   // the last round it took part in
  Stop stop = Stop::none;
};

}  // namespace rehearse::optim
