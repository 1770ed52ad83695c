#pragma once

#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"

namespace rehearse::rollout {

/// The starts and horizons of forecasts by particles.
struct Journeys {
  std::vector<Index> starts;    // steps of the episode
  std::vector<Index> horizons;  // ascending, ≥ 1: steps further on
  Index particles = 1;          // a start
  Vector start_std;             // dx, of the error of the state measured there; empty: 0
};

/// The states at which particles arrive that a model carries on from states of an episode, under the actions that were
/// taken and in the model's uncertainty at every step. Element i has a row (dx) for each particle of each start after
/// horizons[i] steps, those of a start one after the other; NaN beyond the episode's end, or once a prediction was not
/// finite. Row and step draw from the stream (key, candidate = start, particle) alone. The evaluator is asked before
/// each step whether to stop. Throws InvalidInput where sizes are wrong.
std::vector<Matrix> forecast_particles(const dynamics::DynamicsModel& model, const Episode& episode,
                                       const Journeys& journeys, const StreamKey& key, const Evaluator& evaluator);

}  // namespace rehearse::rollout
