#pragma once

#include <string>
#include <vector>

#include "rehearse/system/simulator.hpp"

namespace rehearse::testing {

/// The laws of a simulator, tried on rows that it can simulate: X (n × dx), U (n × du), n ≥ 2, at parameters phi.
/// Returns a line for each law that is broken; empty if all hold:
///
/// - a row depends on that row alone: to the bit the same in the batch, in a part of it, and by itself;
/// - the same call gives the same bytes, also from several threads at once;
/// - a row with NaN, ±infinity or ±1e300 in a state or an action never disturbs another row, and a row of NaN is not
///   answered with numbers. The call may throw for such rows: then they are tried one by one, as everywhere.
std::vector<std::string> check_simulator(const system::Simulator& simulator, const ConstMatrixView& X,
                                         const ConstMatrixView& U, const Vector& phi);

}  // namespace rehearse::testing
