#include "rehearse/qd/archive.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::qd {

Archive::Archive(Niches niches, Index parameters)
    : niches_(std::move(niches)), elites_(static_cast<std::size_t>(niches_.size()), -1) {
  if (parameters < 1) throw InvalidInput(fmt::format("solutions have {} parameters, must be ≥ 1", parameters));
  solutions_.resize(parameters, 0);
  descriptors_.resize(niches_.dimensions(), 0);
}

bool Archive::add(Index niche, double performance, const double* descriptor, const double* solution, Index stride) {
  if (niche < 0 || !std::isfinite(performance)) return false;
  Index elite = elite_of(niche);
  if (elite >= 0 && !(performance > performances_(elite))) return false;
  if (elite < 0) {
    elite = size();
    elites_[static_cast<std::size_t>(niche)] = static_cast<std::int32_t>(elite);
    if (elite == performances_.size()) grow();
    filled_.push_back(niche);
  }
  performances_(elite) = performance;
  descriptors_.col(elite) = Vector::Map(descriptor, descriptors_.rows());
  for (Index p = 0; p < parameters(); ++p) solutions_(p, elite) = solution[p * stride];
  return true;
}

/// Doubles what there is room for, so that huge grids cost what is filled of them alone.
void Archive::grow() {
  const Index capacity = std::min(niches_.size(), std::max<Index>(1024, 2 * performances_.size()));
  performances_.conservativeResize(capacity);
  descriptors_.conservativeResize(Eigen::NoChange, capacity);
  solutions_.conservativeResize(Eigen::NoChange, capacity);
  filled_.reserve(static_cast<std::size_t>(capacity));
}

Index Archive::best() const {
  Index best = -1;
  if (size() > 0) performances_.head(size()).maxCoeff(&best);
  return best;
}

Statistics Archive::statistics(double floor) const {
  Statistics s{.filled = size(),
               .coverage = static_cast<double>(size()) / static_cast<double>(niches_.size()),
               .best = -kInf,
               .mean = kNaN};
  if (size() == 0) return s;
  double sum = 0;
  for (Index elite = 0; elite < size(); ++elite) {
    sum += performances_(elite);
    s.qd_score += performances_(elite) - floor;
    s.best = std::max(s.best, performances_(elite));
  }
  s.mean = sum / static_cast<double>(size());
  return s;
}

}  // namespace rehearse::qd
