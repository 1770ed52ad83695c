#pragma once
// Counter-based random streams: a number depends only on what it is for, never on how many were drawn before it
// or on which thread. Philox4x64-10 (Salmon 2011), from Random123.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// The purpose of a stream's numbers. Values are part of the results: append, never renumber.
enum class Purpose : std::uint8_t {
  start_state = 1,            // and all noise of an episode on a plant
  simulated_start = 2,        // of a rollout in a model
  simulated_noise = 3,        // the model's uncertainty, at every step
  simulated_measurement = 4,  // noise of what the policy sees in a rollout
  random_policy = 5,
  search = 6,  // the candidates of CMA-ES
  selection = 7,
  tessellation = 8,
  variation = 9,
  resampling = 10,
  drawn_option = 11,
  test = 12,
  doubt = 13,    // parameters that a prior may have as well as its own
  dropout = 14,  // weights that a step of a search by gradient leaves out
  states = 15,   // from which feedback is tried
};

/// The system that a learner's trials run on.
enum class Phase : std::uint8_t {
  robot = 0,
  prior = 1,  // before the first trial on the robot (PILCO with priors)
};

/// The part of a trial that a stream belongs to. Values are part of the results: append, never renumber.
enum class Stage : std::uint8_t {
  episode = 0,         // on the plant
  search = 1,          // of a policy, in the model's uncertainty
  solving_search = 2,  // of a policy that solves the task
  judging = 3,         // comparison of policies of several searches, all in the same simulated episodes
  solving = 4,         // how often policies solve the task, all in the same simulated episodes
  mean_solving = 5,    // the same in the mean predictions
  prediction = 6,      // what the model expects of the policy that is tried
  evaluation = 7,      // extra episodes on the plant
  safe_search = 8,     // of a policy, where the search before found none that keeps the limits
  goal = 9,            // where feedback holds the robot, and from where
};

/// The name of a stream: a field for every thing that its numbers depend on. Streams whose keys differ in any field are
/// independent.
struct StreamKey {
  std::uint64_t seed = 1;
  std::uint64_t trial = 0;  // below 2^32
  Phase phase = Phase::robot;
  Stage stage = Stage::episode;
  std::uint64_t search = 0;  // number of the search within its stage, below 2^16
  Purpose purpose = Purpose::test;
  std::uint64_t descent = 0;    // number of the descent or restart within a search, below 2^32
  std::uint64_t candidate = 0;  // number of the candidate within a search
  std::uint64_t particle = 0;   // number of the rollout of a candidate

  friend bool operator==(const StreamKey&, const StreamKey&) = default;
};

/// Draws from one stream, one number after the other. A value; not shared between threads.
class Rng {
 public:
  using result_type = std::uint64_t;

  explicit Rng(const StreamKey& key);  // throws InvalidInput if a field is beyond its width

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
/// step), whatever the other rows. `stream.candidate` and `stream.particle` are ignored. Throws InvalidInput if a field
/// is beyond its width. Any thread.
void fill_normals(const StreamKey& stream, const std::uint64_t* candidates, const std::uint64_t* particles,
                  std::uint64_t step, MatrixView normals);

/// Called for every stream that is opened: an Rng, or a row of `fill_normals`, which has a step. For tests that check
/// which code draws from which stream; called on any thread.
using StreamObserver = std::function<void(const StreamKey& key, std::optional<std::uint64_t> step)>;

/// Calls an observer for all streams while this object lives. At most one such object at a time.
class ObservedStreams {
 public:
  explicit ObservedStreams(StreamObserver observer);
  ~ObservedStreams();
  ObservedStreams(const ObservedStreams&) = delete;
  ObservedStreams& operator=(const ObservedStreams&) = delete;

 private:
  StreamObserver observer_;
};

}  // namespace rehearse
