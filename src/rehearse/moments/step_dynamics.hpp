#pragma once

#include <memory>
#include <utility>

#include "rehearse/moments/moment_matching.hpp"
#include "rehearse/moments/prior_moments.hpp"

namespace rehearse::moments {

/// The change of the state in a control step: that of GPs, that of a prior, or, around a prior, the sum of both.
struct StepDynamics {
  std::shared_ptr<const MomentMatching> gps;  // of (features, actions), the changes of all states; null: there are none
  std::shared_ptr<const PriorMoments> prior;  // null: the GPs are around zero, or networks are their means

  StepDynamics() = default;
  StepDynamics(std::shared_ptr<const MomentMatching> of_gps,  // NOLINT(google-explicit-constructor)
               std::shared_ptr<const PriorMoments> of_prior = {})
      : gps(std::move(of_gps)), prior(std::move(of_prior)) {}

  explicit operator bool() const { return gps || prior; }
  Index states() const { return gps ? gps->outputs() : prior->states(); }
};

}  // namespace rehearse::moments
