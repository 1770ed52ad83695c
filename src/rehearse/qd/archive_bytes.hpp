#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "rehearse/qd/archive.hpp"

namespace rehearse::qd {

/// A search at rest: with an archive and these counts MapElites::resume goes on exactly.
struct Search {
  Archive archive;
  std::uint64_t evaluations = 0, failed = 0;
  std::string about;  // a description of its inputs, by the caller who kept it
};

/// A compact file: a header (magic, version, byte order, sizes, checksum), then `about`, the niches and the elites in
/// order, with exact doubles.
std::string to_bytes(const Search& search);

/// Writes the right checksum into any bytes that are long enough, for tests of the checks behind it.
void fit_checksum(std::string& bytes);

/// Throws InvalidInput with one line, which begins with `name`, if the bytes are not an archive, of another version or
/// byte order, truncated, damaged, or contradict themselves. Nothing is allocated for sizes that the bytes do not have,
/// but for the niches of a grid.
Search from_bytes(std::string_view bytes, const std::string& name);

}  // namespace rehearse::qd
