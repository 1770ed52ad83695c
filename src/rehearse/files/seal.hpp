#pragma once
// Bytes behind a header that reveals truncation and damage: "rehearse-KIND FORMAT BYTES CHECKSUM\n".

#include <string>
#include <string_view>

namespace rehearse::files {

/// kind: what it is, "checkpoint"; in messages too.
std::string seal(std::string_view kind, std::string_view body);

/// The body. Throws InvalidInput where the bytes are truncated, damaged or something else.
std::string_view unseal(std::string_view kind, std::string_view bytes);

}  // namespace rehearse::files
