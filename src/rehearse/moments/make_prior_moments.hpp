#pragma once

#include <memory>

#include "rehearse/moments/prior_moments.hpp"

namespace rehearse::moments {

/// The propagation of a Gaussian through a prior, which is a black box and has no moments in closed form.
enum class Through {
  linearised,  // the prior's slopes at the mean (Saveriano 2017)
  unscented,   // 2 n points with the Gaussian's mean and covariance (Julier 1997; of this weight: Arasaratnam 2009)
};

/// Throws InvalidInput if φ has another size than the prior's parameters.
std::shared_ptr<const PriorMoments> make_prior_moments(prior::Prior prior, Vector phi, Index states, Index actions,
                                                       Through through);

}  // namespace rehearse::moments
