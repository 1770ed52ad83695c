#include "rehearse/rollout/particles.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/rollout/simulation.hpp"

namespace rehearse::rollout {
namespace {

constexpr Index kUsualStarts = 4;  // of a chunk

void check(const Episode& episode, const Journeys& of) {
  const bool ascending = std::ranges::is_sorted(of.horizons) && (of.horizons.empty() || of.horizons.front() >= 1);
  const bool inside =
      std::ranges::all_of(of.starts, [&](Index start) { return start >= 0 && start < episode.steps(); });
  const bool sized = of.start_std.size() == 0 || of.start_std.size() == episode.states.cols();
  if (!ascending || !inside || !sized || of.particles < 1)
    throw InvalidInput(
        fmt::format("particles = {}, must be ≥ 1; horizons must be ascending from 1 on, starts in 0 to "
                    "{}, deviations as many as states",
                    of.particles, episode.steps() - 1));
}

/// Some starts in lockstep.
class Chunk {
 public:
  Chunk(const Episode& episode, const Journeys& journeys, StreamKey key, Index first, Index count)
      : episode_(episode), key_(key), rows_(count * journeys.particles) {
    for (Index row = 0; row < rows_; ++row) {
      starts_.push_back(journeys.starts[static_cast<std::size_t>(first + row / journeys.particles)]);
      candidates_.push_back(static_cast<std::uint64_t>(starts_.back()));
      particles_.push_back(static_cast<std::uint64_t>(row % journeys.particles));
    }
    const Index dx = episode.states.cols();
    X_.resize(rows_, dx), change_.resize(rows_, dx), normals_.resize(rows_, dx);
    U_.resize(rows_, episode.actions.cols());
    for (Index row = 0; row < rows_; ++row) X_.row(row) = episode_.states.row(starts_[static_cast<std::size_t>(row)]);
    if (journeys.start_std.size() == 0) return;
    draw(Purpose::simulated_measurement, 0);
    X_ += normals_ * journeys.start_std.asDiagonal();
  }

  void step(const dynamics::DynamicsModel& model, Index t) {
    for (Index row = 0; row < rows_; ++row) {
      const Index at = starts_[static_cast<std::size_t>(row)] + t;
      if (at >= episode_.steps() || !X_.row(row).allFinite()) X_.row(row).setConstant(kNone);
      U_.row(row) = episode_.actions.row(std::min(at, episode_.steps() - 1));
    }
    const Matrix going = X_;
    for (Index row = 0; row < rows_; ++row)  // what has failed is no input for a model
      if (!X_.row(row).allFinite()) X_.row(row) = episode_.states.row(starts_[static_cast<std::size_t>(row)]);
    if (model.certain()) {
      model.predict_mean(X_, U_, change_);
    } else {
      draw(Purpose::simulated_noise, t);
      model.sample(X_, U_, normals_, change_);
    }
    X_ = going + change_;
  }

  const Matrix& states() const { return X_; }

 private:
  static constexpr double kNone = kNaN;

  void draw(Purpose purpose, Index t) {
    key_.purpose = purpose;
    fill_normals(key_, candidates_.data(), particles_.data(), static_cast<std::uint64_t>(t), normals_);
  }

  const Episode& episode_;
  StreamKey key_;
  Index rows_;
  std::vector<Index> starts_;
  std::vector<std::uint64_t> candidates_, particles_;
  Matrix X_, U_, change_, normals_;
};

}  // namespace

std::vector<Matrix> forecast_particles(const dynamics::DynamicsModel& model, const Episode& episode,
                                       const Journeys& journeys, const StreamKey& key, const Evaluator& evaluator) {
  check(episode, journeys);
  const auto starts = static_cast<Index>(journeys.starts.size());
  const Index particles = journeys.particles;
  const Index most = groups_of_chunk(starts, particles, kUsualStarts, model.rows_at_once());
  std::vector<Matrix> arrived(journeys.horizons.size(), Matrix(starts * particles, episode.states.cols()));
  evaluator.for_each((starts + most - 1) / most, [&](Index c) {
    const Index first = c * most, count = std::min(most, starts - first);
    Chunk chunk(episode, journeys, key, first, count);
    Index t = 0;
    for (std::size_t i = 0; i < journeys.horizons.size(); ++i) {
      for (; t < journeys.horizons[i]; ++t) {
        evaluator.stop_if_asked();
        chunk.step(model, t);
      }
      arrived[i].middleRows(first * particles, count * particles) = chunk.states();
    }
  });
  return arrived;
}

}  // namespace rehearse::rollout
