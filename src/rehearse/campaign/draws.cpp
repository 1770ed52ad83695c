#include "rehearse/campaign/draws.hpp"

#include <fmt/format.h>

#include "rehearse/core/random.hpp"
#include "rehearse/files/checksum.hpp"

namespace rehearse::campaign {

experiment::FileOption drawn(const Draw& draw, Index seed) {
  Rng rng({.seed = static_cast<std::uint64_t>(seed),
           .purpose = Purpose::drawn_option,
           .candidate = files::checksum(draw.key)});
  return {draw.key, fmt::to_string(rng.uniform(draw.low, draw.high)), draw.line};
}

}  // namespace rehearse::campaign
