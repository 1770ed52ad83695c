#pragma once
// Bytes that tell whether they are whole: "rehearse-KIND FORMAT BYTES CHECKSUM\n" stands before them.

#include <string>
#include <string_view>

namespace rehearse::files {

/// kind: what it is, "checkpoint"; in messages too.
std::string seal(std::string_view kind, std::string_view body);

/// The body. Throws InvalidInput where the bytes are truncated, damaged or something else.
std::string_view unseal(std::string_view kind, std::string_view bytes);

}  // namespace rehearse::files
