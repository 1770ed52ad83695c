#pragma once
// Simulation outside this process, by workers that may die or hang.

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "rehearse/core/pool.hpp"
#include "rehearse/core/types.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::system {

/// The faults of workers so far.
struct Faults {
  Index count = 0;
  Index lost = 0;    // rows that were given up though another try might answer them: of workers that died or hung
  std::string last;  // for people
};

/// A simulator outside this process.
class Worker {
 public:
  virtual ~Worker() = default;

  /// Writes the changes dX (n × dx) of states X (n × dx) under actions U (n × du). Returns how many rows it answered,
  /// from the first on; if that is not all of them, the worker is unusable unless it declined.
  virtual Index change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) = 0;

  /// The reason why it did not answer, for people.
  virtual std::string problem() const { return {}; }

  /// True if it answered that it cannot, so that it may be asked for other rows.
  virtual bool declined() const { return false; }

  /// True if it kept its caller waiting, or never got ready.
  virtual bool costly() const { return false; }

  /// The last call: it may begin to end, and its destructor waits until it has.
  virtual void leave() noexcept {}
};

/// A pool of workers, one for each concurrent call, started when they are needed. A row that a worker does not answer
/// is given once more to a new one and comes back as NaN if that fails, too: a worker that is killed from outside
/// changes no number. One that declines is kept, and not asked for that row again. Where a batch is answered as a whole
/// it is halved until the row is found, and grows again from there: such rows are seldom alone. Rows of a call that are
/// the same as one that came back as NaN are not asked for. Any thread.
class Workers {
 public:
  struct Options {
    std::function<std::unique_ptr<Worker>()> start;
    bool row_by_row = false;  // each row is answered by itself: the first that is missing is to blame
    Index patience = 0;  // consecutive faults, of all calls, before a row is tried that was answered before; 0: endless
  };
  explicit Workers(Options options) : options_(std::move(options)) {}
  ~Workers();  // all workers leave before it waits for one of them
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// X: n × dx, U: n × du, dX: n × dx. Throws Unavailable where patience ends and even that row is not answered, nor,
  /// where none ever was, any of some rows of these.
  void change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const;

  Faults faults() const;

 private:
  struct KnownRows {
    Matrix X, U;
    Vector phi;
  };

  static KnownRows some_of(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi);
  void remember(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi) const;  // a row was answered
  void lose() const;                                                                           // a row was given up
  bool still_patient_after(Index faults) const;  // of so many more in a row
  bool note(const Worker& worker) const;         // counts its fault; false: patience ends
  std::unique_ptr<Worker> one_that_answers(std::unique_ptr<Worker> worker, const ConstMatrixView& X,
                                           const ConstMatrixView& U, const Vector& phi) const;

  Options options_;
  mutable Pool<Worker> idle_;
  mutable std::mutex mutex_;  // of what follows
  mutable std::optional<KnownRows> known_;
  mutable Index faults_in_a_row_ = 0;
  mutable Faults faults_;
};

}  // namespace rehearse::system
