#pragma once
// The rows that a prior could not simulate, in the words of a note.

#include <string>

#include "rehearse/learners/learner.hpp"

namespace rehearse::learners {

/// The setting whose prior, if it has one, keeps a row that fails.
Setting watched(Setting setting);

/// Forgets what failed until now. setting: a watched one.
void forget_faults(const Setting& setting);

/// A row that failed since, "in x = 1, v = 2 under u = 0.5: no licence"; empty: none did.
std::string fault_of_prior(const Setting& setting);

}  // namespace rehearse::learners
