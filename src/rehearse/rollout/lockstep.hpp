#pragma once

#include <cstdint>
#include <vector>

#include "rehearse/rollout/episodes.hpp"
#include "rehearse/rollout/simulation.hpp"

namespace rehearse::rollout {

/// A step of all rows of a chunk, as a reverse pass reads it.
struct TapedStep {
  Matrix seen;       // rows × dx, what the policy saw
  Matrix next_by;    // rows × dx·(dx+du), derivatives of the state reached, as those of dynamics::Linearised
  Matrix earned_by;  // as step_slopes.hpp
  std::vector<char> earned, went_on;  // the row was alive and its reward counted; it is alive after the step
};

/// Memory of a chunk, kept by each thread from one to the next: fresh pages cost more than a step of a cheap model.
struct LockstepMemory {
  Matrix Theta, X, seen, next, noise, U, U_before, kept;
  Matrix holds, broken;  // rows × limits
  Vector reward, cost, returns, ended, factor;
  std::vector<std::uint64_t> candidates, particles;
  std::vector<Index> places, alive_rows;  // where a row's returns are written, and its record
  std::vector<char> alive;
  dynamics::Linearised linearised;
};

/// Some rows of a batch in lockstep, each a particle of a candidate: the steps of simulate.hpp. For those who write a
/// loop over time.
class Lockstep {
 public:
  Lockstep(const Simulation& of, Index rows, LockstepMemory& memory);

  void set_row(Index row, const ConstVectorView& theta, std::uint64_t candidate, std::uint64_t particle);
  void set_rows(const ConstMatrixView& Theta, const Numbering& candidates);

  void start();

  /// x_t → x_{t+1} for every row; what happens is recorded, or taped, if it is to be. A taped step takes every draw to
  /// be the model's mean and so many deviations of each state by itself, which servos' draws are not.
  void step(Index t, Episodes* record = nullptr, TapedStep* tape = nullptr);

  /// Goes on with the rows that are alive alone, once an eighth has ended; false: none is alive. Rows keep their places
  /// in returns(), broken() and records, while states() and alive() have fewer. Not for tapes, which want all rows.
  bool drop_ended();

  const Matrix& states() const { return m_.X; }
  const Vector& returns() const { return m_.returns; }
  const Matrix& broken() const { return m_.broken; }
  bool alive(Index row) const { return m_.alive[static_cast<std::size_t>(row)] != 0; }
  Index failed() const { return failed_; }

 private:
  void resize(Index rows);
  const Matrix& measured(Index t);
  void draw(Purpose purpose, Index t);
  void draw_noise(Index t);
  void move(Index t);
  void move(Index t, TapedStep& tape);
  void write(Index t, Episodes& record);
  bool finite(Index row) const;
  void settle(Index row, Index t);
  bool breaks(Index row) const;
  bool ended(Index row) const { return is_true(m_.ended(row)); }
  bool remembers_actions() const { return task_.cost || !task_.limits.empty(); }
  bool uncertain() const { return options_.sample && !model_.certain(); }

  const dynamics::DynamicsModel& model_;
  const policy::Policy& policy_;
  const Task& task_;
  Actuators actuators_ = task_.actuators();
  StreamKey key_;
  SimulateOptions options_;
  LockstepMemory& m_;
  Index failed_ = 0;
};

}  // namespace rehearse::rollout
