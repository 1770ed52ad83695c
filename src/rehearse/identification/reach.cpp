#include "rehearse/identification/reach.hpp"

#include <algorithm>
#include <cmath>

namespace rehearse::identification {
namespace {

constexpr double kFirstStep = 1e-3, kLargestStep = 0.1, kLeastStep = 5e-4;  // fractions of the box
constexpr Index kMostReachSteps = 20;                                       // of the others, each time
constexpr double kNear = 0.1;                                               // of the tolerance: as good as the minimum

class Walk {
 public:
  Walk(const optim::SquaresProblem& problem, const Vector& start, double tolerance)
      : problem_(problem), start_(optim::minimise_squares(problem, start)), limit_(start_.value + tolerance) {
    problem_.negligible = start_.value + kNear * tolerance;
  }

  /// The last place of coordinate i that way, and one beyond that was not reached, or the border.
  struct End {
    double last, beyond;
  };
  End go(Index i, double direction, std::vector<Vector>& points) {
    const double border = direction < 0 ? problem_.low(i) : problem_.high(i);
    Vector at = start_.x, before = at;
    double step = kFirstStep, beyond = at(i);
    while (at(i) != border && step >= kLeastStep) {
      const double left = std::abs(border - at(i));
      beyond = step < left ? at(i) + direction * step : border;
      const optim::SquaresResult found = follow(at, before, i, beyond);
      if (!(found.value <= limit_)) {
        step = std::min(step, left) / 2;
        continue;
      }
      before = at;
      at = found.x;
      points.push_back(at);
      step = std::min(2 * step, kLargestStep);
    }
    return {at(i), beyond};
  }

  const Vector& start() const { return start_.x; }

 private:
  /// The minimum with coordinate i at `to`, looked for where the last two points lead.
  optim::SquaresResult follow(const Vector& at, const Vector& before, Index i, double to) const {
    Vector guess = at;
    const double last = at(i) - before(i);
    if (last != 0) guess += (at - before) * ((to - at(i)) / last);
    guess = guess.cwiseMax(problem_.low).cwiseMin(problem_.high);
    guess(i) = to;
    optim::SquaresProblem held = problem_;
    held.low(i) = held.high(i) = to;
    return optim::minimise_squares(held, guess, {.max_steps = kMostReachSteps});
  }

  optim::SquaresProblem problem_;
  const optim::SquaresResult start_;
  const double limit_;
};

}  // namespace

Reach reach(const optim::SquaresProblem& problem, const Vector& start, const std::vector<Index>& coordinates,
            double tolerance) {
  Reach result{std::vector<std::optional<Interval>>(static_cast<std::size_t>(start.size())), {}};
  Walk walk(problem, start, tolerance);
  std::vector<Vector> points;
  for (const Index i : coordinates) {
    const Walk::End low = walk.go(i, -1, points), high = walk.go(i, 1, points);
    if (low.last < high.last) result.ranges[static_cast<std::size_t>(i)] = {low.beyond, high.beyond};
  }
  result.points.resize(start.size(), static_cast<Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) result.points.col(static_cast<Index>(k)) = points[k];
  return result;
}

}  // namespace rehearse::identification
