#pragma once

#include "rehearse/policy/squash.hpp"

namespace rehearse::policy {

/// a: n × actions, replaced by the derivatives of the squashed actions by them.
void squash_slope(const Squash& squash, MatrixView a);

}  // namespace rehearse::policy
