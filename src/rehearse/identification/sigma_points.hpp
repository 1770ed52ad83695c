#pragma once
// A few φ that stand for a whole posterior.

#include <vector>

#include "rehearse/core/parameters.hpp"
#include "rehearse/identification/phi_posterior.hpp"

namespace rehearse::identification {

/// 2q values of φ for the q parameters of a posterior, each as likely as another: their mean and covariance are the
/// posterior's (Arasaratnam 2009), but that each stays in its box. φ has the values of all others.
std::vector<Vector> sigma_points(const PhiPosterior& posterior, const ParameterSpace& space, const Vector& phi);

}  // namespace rehearse::identification
