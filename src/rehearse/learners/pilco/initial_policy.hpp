#pragma once

#include "rehearse/core/random.hpp"
#include "rehearse/moments/gaussian.hpp"
#include "rehearse/policy/policy.hpp"

namespace rehearse::learners::pilco {

/// The first θ of an analytic policy, PILCO's, where episodes begin in `start`. `key` names the draw; its purpose is of
/// no account.
///
/// rbf: centres drawn from the features of the start, targets from N(0, 0.1²), length scales of 1, of cosines and sines
/// 0.7. linear: weights from N(0, 0.01²), no offset.
Vector initial_policy(const policy::Policy& policy, const moments::Gaussian& start, StreamKey key);

/// The units of an analytic policy's θ, one a parameter: a centre or a weight has the unit of the feature itself.
/// PILCO's policies have features that are not scaled, and its steps depend on it.
Vector units_of(const policy::Policy& policy);

}  // namespace rehearse::learners::pilco
