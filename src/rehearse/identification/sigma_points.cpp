#include "rehearse/identification/sigma_points.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace rehearse::identification {

std::vector<Vector> sigma_points(const PhiPosterior& posterior, const ParameterSpace& space, const Vector& phi) {
  const auto q = posterior.mean.size();
  const Matrix L = posterior.covariance.llt().matrixL();
  const Matrix way = std::sqrt(static_cast<double>(q)) * L;
  const std::vector<Index> tuned = space.of_kind(Parameter::Kind::continuous);
  std::vector<Vector> points;
  for (Index i = 0; i < q; ++i)
    for (const double side : {1.0, -1.0}) {
      points.push_back(phi);
      for (Index j = 0; j < q; ++j) {
        const Index k = tuned[static_cast<std::size_t>(j)];
        points.back()(k) = std::clamp(posterior.mean(j) + side * way(j, i), space[k].box.low, space[k].box.high);
      }
    }
  return points;
}

}  // namespace rehearse::identification
