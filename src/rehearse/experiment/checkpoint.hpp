#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "rehearse/experiment/record.hpp"

namespace rehearse::experiment {

/// A history as bytes, with exact doubles, the fingerprint of the spec that it belongs to, and a checksum.
std::string to_checkpoint(const History& history, std::uint64_t spec_fingerprint);

/// Throws InvalidInput if the bytes are truncated, damaged, of another version of Rehearse, or of another spec.
History from_checkpoint(std::string_view bytes, std::uint64_t spec_fingerprint);

}  // namespace rehearse::experiment
