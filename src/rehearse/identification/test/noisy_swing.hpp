#pragma once

#include <cstdint>

#include "rehearse/core/random.hpp"
#include "rehearse/dynamics/test/swing.hpp"

namespace rehearse::identification::swing {

using namespace rehearse::swing;  // NOLINT(google-build-using-namespace)

/// Steps of the true swing with white noise on their changes.
inline Dataset data_with_noise(Index rows, std::uint64_t seed, double deviation) {
  Dataset data = swing::data(rows, seed);
  Rng rng({.seed = seed, .trial = 1});
  for (double& change : data.changes.reshaped()) change += deviation * rng.normal();
  return data;
}

}  // namespace rehearse::identification::swing
