#pragma once
// Odd functions: those that change their signs with some of their inputs, while others, cosines of angles, stay. With s
// the signs of the image ȳ = s ∘ y of an input (D, each 1 or −1), their covariance is
//
//   k(x, y) − k(x, ȳ)
//
// with k of hyperparameters.hpp, which is the same for the images of both. So each target tells two values, at its
// input and at the image. Without a trend, inputs far from their images have the variance of k.

#include "rehearse/gp/evidence.hpp"
#include "rehearse/gp/hyperparameters.hpp"
#include "rehearse/gp/inputs.hpp"

namespace rehearse::gp {

/// The images of the unit inputs, in the same units (n × D).
Matrix unit_images(const Inputs& inputs, const Vector& signs);

/// The covariance over σ_f² at the inputs, without noise (n × n). Any thread.
Matrix odd_covariance(const Inputs& inputs, const Vector& signs, const Hyperparameters& kernel);

/// The log evidence of targets y (n) of an odd function; as `evidence` where it cannot be computed.
Evidence odd_evidence(const Inputs& inputs, const Vector& signs, const ConstVectorView& y,
                      const Hyperparameters& kernel);

}  // namespace rehearse::gp
