#pragma once
// Counter-based random streams: a number depends only on what it is for, never on how many were drawn before it
// or on which thread. Philox4x64-10 (Salmon 2011), from Random123.

#include <array>
#include <cstdint>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// What random numbers are for. Values are part of the results: append, never renumber.
enum class Purpose : std::uint32_t {
  start_state = 1,
  process_noise = 2,
  measurement_noise = 3,
  random_policy = 4,
  search = 5,
  imagined_start = 6,
  imagined_noise = 7,
  selection = 8,
  prediction = 9,
  test = 10,
  resampling = 11,
  evaluation = 12,
  tessellation = 13,
  variation = 14,
  drawn_option = 15,
  imagined_measurement = 16,
};

/// The name of a stream.
struct StreamKey {
  std::uint64_t seed = 1;
  std::uint64_t trial = 0;
  Purpose purpose = Purpose::test;
  std::uint64_t candidate = 0;
  std::uint64_t particle = 0;
};

/// Draws from one stream, one number after the other. A value; not shared between threads.
class Rng {
 public:
  using result_type = std::uint64_t;

  explicit Rng(const StreamKey& key);

  std::uint64_t operator()();               // 64 random bits
  double uniform();                         // in [0, 1)
  double uniform(double low, double high);  // in [low, high)
  double normal();                          // N(0, 1)
  Index below(Index n);                     // in 0..n−1, n ≥ 1

  static constexpr std::uint64_t min() { return 0; }
  static constexpr std::uint64_t max() { return ~std::uint64_t{0}; }

 private:
  std::array<std::uint64_t, 2> key_;
  std::array<std::uint64_t, 4> counter_;
  std::array<std::uint64_t, 4> block_{};
  unsigned used_ = 4;
  double spare_normal_ = 0;
  bool has_spare_ = false;
};

/// Fills normals (rows × columns) with N(0, 1): row i depends only on (key of `stream`, candidates[i], particles[i],
/// step), whatever the other rows. `stream.candidate` and `stream.particle` are ignored. Any thread.
void fill_normals(const StreamKey& stream, const std::uint64_t* candidates, const std::uint64_t* particles,
                  std::uint64_t step, MatrixView normals);

}  // namespace rehearse
