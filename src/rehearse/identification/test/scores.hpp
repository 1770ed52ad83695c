#pragma once

#include "rehearse/identification/score.hpp"

namespace rehearse::identification {

inline constexpr Score kScores[] = {Score::sum, Score::product, Score::harmonic};

}  // namespace rehearse::identification
