#pragma once
// Many short descents of CMA-ES that compete: after each round the better ones go on and the others stop (successive
// halving; Jamieson and Talwalkar 2016). Where a function has several families of solutions this finds the better
// one with fewer evaluations than restarts one after the other, and its generations make large batches.

#include <string>
#include <vector>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/optim/cmaes.hpp"
#include "rehearse/optim/objective.hpp"

namespace rehearse::optim {

struct RaceOptions {
  Index max_evaluations = 100000;  // of the objective, re-evaluations included
  Index descents = 32;             // that start
  Index rounds = 5;          // of about equal numbers of evaluations; one too small to judge all goes on in the next
  double survivors = 0.5;    // fraction of the descents that goes on after each round
  double sigma = 1;          // first step size of descents from random points
  double start_sigma = 0.5;  // and of those from given starts
  double near_centre = 0.2;  // every second descent from a random point starts in this fraction of the box, around its
                             // centre, with this fraction of sigma; 1: as the others
  Index judgements = 16;     // evaluations of a descent's best point and mean when a round ends; in the last one
                             // fewer, where max_evaluations asks for it
  CmaesOptions cmaes{.population = 17};
  void fields(FieldVisitor& v);
};

/// A point that a descent ended with: the better of its best point and its mean.
struct Contender {
  Vector x;
  double value = 0;  // mean of the judgements
  Index round = 0;   // the last round its descent took part in
  std::string stop;  // why its descent ended
};

struct RaceResult {
  std::vector<Contender> contenders;  // one a descent, best value first
  Index evaluations = 0;
};

/// The box that a race searches, and its starts: the first descents begin at the given starts (at most all of them),
/// the others in turn uniformly in the box and near its centre. Weights near zero make smooth policies of a network,
/// weights of the whole box steep ones; which a task needs is not known before.
struct SearchSpace {
  std::vector<Interval> box;
  std::vector<Vector> starts = {};
};

/// Maximises within the box. Results depend on the key, never on the evaluator. Throws InvalidInput.
RaceResult race(const BatchObjective& objective, const SearchSpace& space, const RaceOptions& options,
                const StreamKey& key, const Evaluator& evaluator, const SearchListener& listener = {});

}  // namespace rehearse::optim
