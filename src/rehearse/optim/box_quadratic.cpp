#include "rehearse/optim/box_quadratic.hpp"

#include <vector>

#include <Eigen/Cholesky>

namespace rehearse::optim {
namespace {

constexpr int kMostSteps = 100;
constexpr double kSmallestStep = 1e-22;  // of the line search
constexpr double kArmijo = 0.1;          // fraction of the promised descent that a step must make
constexpr double kConverged = 1e-12;     // of a step, relative to the gradient's scale

std::vector<Index> indices_of(const Eigen::Array<bool, -1, 1>& mask) {
  std::vector<Index> indices;
  for (Index i = 0; i < mask.size(); ++i)
    if (mask(i)) indices.push_back(i);
  return indices;
}

}  // namespace

std::optional<BoxMinimum> minimise_in_box(const Matrix& H, const Vector& g, const Vector& low, const Vector& high,
                                          const Vector& start) {
  if (!H.allFinite() || !g.allFinite() || Eigen::LLT<Matrix>(H).info() != Eigen::Success) return std::nullopt;
  BoxMinimum best{.x = start.cwiseMax(low).cwiseMin(high), .free = {}, .factor_free = Eigen::LLT<Matrix>(Matrix(0, 0))};
  Vector& x = best.x;
  const auto value = [&](const Vector& at) { return at.dot(0.5 * (H * at) + g); };
  for (int step = 0; step < kMostSteps; ++step) {
    const Vector gradient = H * x + g;
    best.free =
        !((x.array() <= low.array() && gradient.array() > 0) || (x.array() >= high.array() && gradient.array() < 0));
    const std::vector<Index> free = indices_of(best.free);
    if (free.empty()) return best;
    best.factor_free.compute(H(free, free));
    Vector direction = Vector::Zero(x.size());
    direction(free) = -best.factor_free.solve(Vector(gradient(free)));
    const double slope = gradient.dot(direction);
    if (-slope <= kConverged * kConverged * (1 + gradient.squaredNorm())) return best;
    double size = 1;
    Vector next = (x + direction).cwiseMax(low).cwiseMin(high);
    while (value(next) > value(x) + kArmijo * size * slope && size > kSmallestStep) {
      size *= 0.6;
      next = (x + size * direction).cwiseMax(low).cwiseMin(high);
    }
    if (next == x) return best;
    x = next;
  }
  return best;
}

}  // namespace rehearse::optim
