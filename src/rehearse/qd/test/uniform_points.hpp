#pragma once

#include "rehearse/core/random.hpp"
#include "rehearse/core/types.hpp"

namespace rehearse::qd {

/// D × n, uniform in [low, high).
inline Matrix uniform_points(Index D, Index n, double low, double high, std::uint64_t seed) {
  Rng rng({.seed = seed});
  return Matrix::NullaryExpr(D, n, [&] { return rng.uniform(low, high); });
}

}  // namespace rehearse::qd
