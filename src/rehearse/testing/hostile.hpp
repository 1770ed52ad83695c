#pragma once

#include <memory>

#include "rehearse/system/simulator.hpp"

namespace rehearse::testing {

/// The harm that a hostile simulator does to some rows.
enum class Harm {
  nan,        // they come back as NaN
  huge,       // as 1e300
  exception,  // the call throws std::runtime_error if it holds such a row
};

/// A simulator that fails in about the given fraction of its rows, chosen by a hash of the row's state and action:
/// always the same ones, whatever the batch. For tests of a learner's, or your own code's, robustness.
std::shared_ptr<const system::Simulator> make_hostile(std::shared_ptr<const system::Simulator> simulator, Harm harm,
                                                      double fraction);

}  // namespace rehearse::testing
