#pragma once
// For the sources of this room.

#include "rehearse/report/files.hpp"

namespace rehearse::report {

/// The gap between moment matching's prediction of a trial and that of samples (docs/report.md); null where the table,
/// one of predictions/, has the samples alone. Throws InvalidInput if it lacks what they are compared by.
Json prediction_gap(const files::Table& prediction);

}  // namespace rehearse::report
