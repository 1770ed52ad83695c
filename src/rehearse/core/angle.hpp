#pragma once

#include <cmath>
#include <numbers>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// Up to here vectorised sines and cosines take an angle as it is; Highway's are valid up to some 39 000 rad.
constexpr double kDirectAngle = 39000;

/// x − 2πk in [−π, π] for a whole k, within three units of its last place for any finite x (Payne and Hanek 1983); else
/// NaN. Whole numbers and one product: the same bytes on every processor.
double reduced_angle(double x);

/// A difference of angles the shorter way round: in [−π, π].
inline double shorter_way(double difference) { return std::remainder(difference, 2 * std::numbers::pi); }

/// Replaces by `reduced_angle` those of n angles that are not below kDirectAngle in magnitude.
void reduce_far_angles(double* x, Index n);

}  // namespace rehearse
