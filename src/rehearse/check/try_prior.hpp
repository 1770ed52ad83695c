#pragma once

#include <string>
#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::check {

/// The errors of a prior on the plant's steps.
struct PriorTried {
  std::string name;
  Index states = 0;                // on which parameters were tried: those of the steps, and others around them
  Vector error;                    // of each state: root mean square error of its change in a step; NaN: no prediction
  Index failed = 0;                // rows without a prediction
  double rows_per_s = 0;           // on one thread
  std::vector<std::string> idle;   // tunable parameters that change no prediction
  std::string broken;              // the law of simulators that it breaks; empty: none
  std::vector<std::string> notes;  // on what may be wrong, a sentence each
};

/// Asks each prior of a scenario for these steps, and for states further off, where contacts may be. steps: at least
/// one.
std::vector<PriorTried> try_priors(const scenario::Scenario& scenario, const Dataset& steps, std::uint64_t seed);

}  // namespace rehearse::check
