#pragma once
// A robot may be its own mirror image: −x under −u changes by the opposite of what x under u changes by. Then each
// measured step tells what its image would have been. A user may know it, or the data tell.

#include <optional>
#include <string>
#include <vector>

#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/dynamics/residuals.hpp"
#include "rehearse/identification/fit_problem.hpp"

namespace rehearse::identification {

/// The signs of images of GP inputs: features, of which cosines stay, then so many actions (gp/odd.hpp).
Vector signs_of_images(const FeatureMap& features, Index actions);

/// By how many nats the targets of the fit are likelier as those of odd functions, with the same kernels, than as those
/// of any: log p(y | odd) − log p(y), over the outputs that GPs learn. Rows without another's image near them tell
/// nothing. NaN where it cannot be computed.
double nats_for_odd(const dynamics::Residuals& residuals, const dynamics::Residuals::Rows& rows, const Fit& fit);

/// A note if the prior at φ does not do the opposite at the images of the rows. names: of states; where there are none
/// they are counted from 1.
std::optional<std::string> not_its_image(const dynamics::Residuals& rows, const prior::Prior& prior, const Vector& phi,
                                         const std::vector<std::string>& names);

/// A note if the model errs at the rows it was told by much more than their noise, whose variances are given (dx):
/// their images say something else.
std::optional<std::string> contradicts_image(const dynamics::GpModel& model, const dynamics::Residuals& rows,
                                             const Vector& noise, const std::vector<std::string>& names);

}  // namespace rehearse::identification
