#pragma once

#include <functional>
#include <memory>
#include <stdexcept>

#include "rehearse/core/parameters.hpp"
#include "rehearse/core/types.hpp"
#include "rehearse/system/first_fault.hpp"

namespace rehearse::system {

/// The simulator cannot be used any more: this ends a run, while a row that cannot be simulated ends a rollout.
class Unavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The user stopped the work inside of the simulator or plant: no failure.
class Stopped : public Unavailable {
 public:
  using Unavailable::Unavailable;
};

/// A black box that maps states, actions and parameters to state changes over one control step, a batch at a time.
///
/// Laws (checked by testing::check_simulator): `change` may run concurrently; a row depends on that row alone; a row
/// that cannot be simulated comes back as NaN, or the call throws, and then it is retried row by row; Unavailable and
/// std::bad_alloc alone go on to the caller: a lack of memory is not the fault of a row. It must not run oneTBB tasks
/// of its own: the calling thread could pick up another batch in the middle of this one.
class Simulator {
 public:
  virtual ~Simulator() = default;

  /// Names, units and boxes of φ; must not change.
  virtual const ParameterSpace& parameters() const = 0;

  /// X: n × dx, U: n × du, phi: values in the order of parameters(), dX: n × dx.
  virtual void change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const = 0;

  /// The number of rows that a call should have to be worth its cost, if there are so many; 0: it makes no difference.
  virtual Index rows_at_once() const { return 0; }

  /// The simulator of the robot's own states, if this one has actuators in front of it (actuated.hpp); else null.
  virtual std::shared_ptr<const Simulator> behind_actuators() const { return nullptr; }
};

/// Writes dX (n × dx) for X (n × dx), U (n × du) and phi; keeps the laws above.
using Change =
    std::function<void(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX)>;

/// Throws InvalidInput unless all have the same rows, X and dX the same columns, and φ no fewer values than parameters.
void check_sizes(const Simulator& simulator, const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi,
                 const ConstMatrixView& dX);

/// A simulator that is no more than a function.
std::shared_ptr<const Simulator> make_simulator(ParameterSpace parameters, Change change, Index rows_at_once = 0);

/// Contains a hostile simulator: if the batch, of the right sizes, throws it is retried row by row, and rows that throw
/// again, or are not finite, come back as NaN. Unavailable and std::bad_alloc go on to the caller. Returns how many
/// rows failed, and tells `fault`, if there is one, of them.
Index change_contained(const Simulator& simulator, const ConstMatrixView& X, const ConstMatrixView& U,
                       const Vector& phi, MatrixView dX, FirstFault* fault = nullptr);

}  // namespace rehearse::system
