#pragma once
// spec.toml: a spec as a file that can be read, kept, and run again.

#include <cstdint>
#include <string>
#include <string_view>

#include "rehearse/experiment/spec.hpp"

namespace rehearse::experiment {

std::string to_toml(const Spec& spec);

/// Throws InvalidInput with the source's name and line.
Spec from_toml(std::string_view text, const std::string& source_name);

/// Of everything in the spec but when it ends, which a run may change on the way.
std::uint64_t fingerprint(Spec spec);

}  // namespace rehearse::experiment
