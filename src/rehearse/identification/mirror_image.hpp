#pragma once
// A robot may be its own mirror image: −x under −u changes by the opposite of what x under u changes by. Then each
// measured step tells what its image would have been. A user may know it, or the data tell.

#include <optional>
#include <string>
#include <vector>

#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/dynamics/residuals.hpp"
#include "rehearse/gp/hyperparameters.hpp"

namespace rehearse::identification {

/// The rows, and after them their images.
Dataset with_images(const Dataset& data);

/// By how many nats the targets of `rows` (those of with_images, and their kernels, one an output) are likelier as those
/// of odd functions, which change their signs with their inputs, than as those of any function: log p(y | odd) − log
/// p(y), summed over the outputs that are `wanted`. The covariance of an odd function is k(x, y) − k(x, −y), so that rows
/// without another's image near them tell nothing. NaN where it cannot be computed.
double nats_for_odd(const dynamics::Residuals::Rows& rows, const std::vector<gp::Hyperparameters>& kernels,
                    const std::vector<bool>& wanted);

/// A note if the prior does not do the opposite at the images of the rows. `targets`: those of the rows, then of
/// images.
std::optional<std::string> not_its_image(const dynamics::Residuals& rows, const Matrix& targets);

/// A note if the model errs at the rows it was told by much more than their noise, whose variances are given (dx): their
/// images say something else.
std::optional<std::string> contradicts_image(const dynamics::GpModel& model, const dynamics::Residuals& rows,
                                             const Vector& noise);

}  // namespace rehearse::identification
