#pragma once
// One copy of a model, and its data. For the files of this room.

#include <memory>
#include <utility>

#include "rehearse/core/pool.hpp"
#include "rehearse/mujoco/compiled_model.hpp"

namespace rehearse::mujoco {

/// A model in motion. One thread. Unusable after an exception.
class Instance {
 public:
  explicit Instance(SharedModel compiled);

  /// phi in the description's order. Throws InvalidInput where a value is not finite or MuJoCo refuses it.
  void apply(const Vector& phi);

  /// The start of an episode at the state x (dx): whatever happened before is forgotten. Allocates nothing.
  void place(const Vector& x);

  /// A control step under u (du). False if the simulation diverged. Allocates nothing.
  bool step(const Vector& u);

  /// Computes the numbers that states read, after `place` without a step. False if that fails.
  bool look();

  /// Computes the positions of bodies and geoms, which `look` does only for states that need them.
  bool place_bodies();

  /// Writes x (dx). After `step` or `look`.
  void read(Vector& x) const { compiled_->states().read(*data_, x); }

  const CompiledModel& compiled() const { return *compiled_; }
  const mjModel& model() const { return *model_; }
  const mjData& data() const { return *data_; }

 private:
  void start_over();
  bool diverged() const;

  SharedModel compiled_;
  ModelPointer model_;
  DataPointer data_;
  Vector phi_;                       // that the model has
  Vector qpos_, qvel_, act_, ctrl_;  // the start of every row
  bool spoilt_ = false;              // MuJoCo left its data midway
};

/// Instances for as many calls as there are at a time. Any thread.
class Instances {
 public:
  explicit Instances(SharedModel compiled) : compiled_(std::move(compiled)) {}

  const CompiledModel& compiled() const { return *compiled_; }

  /// One at phi. An instance that threw is not given back.
  std::unique_ptr<Instance> take(const Vector& phi) const;
  void give_back(std::unique_ptr<Instance> instance) const { idle_.give_back(std::move(instance)); }

 private:
  SharedModel compiled_;
  mutable Pool<Instance> idle_;
};

}  // namespace rehearse::mujoco
