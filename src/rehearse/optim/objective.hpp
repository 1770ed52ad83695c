#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "rehearse/core/types.hpp"

namespace rehearse::optim {

/// To be maximised: evaluates a batch of candidates, one a column (dimension × batch), each `samples` times, and
/// writes the mean of each candidate's values. Candidate j of the batch has the number first_candidate + j, from
/// which a stochastic objective derives its random stream. NaN counts as the worst value. Candidates are inside the
/// box.
using BatchObjective = std::function<void(const ConstMatrixView& candidates, std::uint64_t first_candidate,
                                          Index samples, VectorView values)>;

/// Hears after each generation: evaluations so far, best value so far. May throw to stop.
using SearchListener = std::function<void(Index evaluations, double best)>;

}  // namespace rehearse::optim
