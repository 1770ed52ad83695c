#pragma once

#include <cstdint>
#include <string_view>

namespace rehearse::files {

/// 64 bits that detect accidental changes (FNV-1a).
inline std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037u;
  for (char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

}  // namespace rehearse::files
