#pragma once
// The range of parameters over which the others can compensate.

#include <optional>
#include <vector>

#include "rehearse/core/types.hpp"
#include "rehearse/optim/least_squares.hpp"

namespace rehearse::identification {

struct Reach {
  std::vector<std::optional<Interval>> ranges;  // q; empty where a coordinate was not asked for, or cannot move
  Matrix points;                                // q × points, those on the way
};

/// From `start` (q) each of these coordinates is moved step by step towards both ends of the box, the others following
/// to where the sum of squares is least, until it is more than `tolerance` above its minimum (the profile likelihood;
/// Venzon and Moolgavkar 1988). Coordinates are fractions of their boxes; ends are known to a thousandth.
Reach reach(const optim::SquaresProblem& problem, const Vector& start, const std::vector<Index>& coordinates,
            double tolerance);

}  // namespace rehearse::identification
