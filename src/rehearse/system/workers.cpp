#include "rehearse/system/workers.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace rehearse::system {
namespace {

constexpr Index kCostly = 8;  // faults that one slow fault counts as

/// The rows to compute next.
class RowsToAsk {
 public:
  RowsToAsk(const ConstMatrixView& X, const ConstMatrixView& U, bool row_by_row)
      : X_(X), U_(U), rows_(X.rows()), ask_(rows_), row_by_row_(row_by_row) {}

  bool done() const { return done_ == rows_; }
  Index first() const { return done_; }

  /// Up to the next row that is one of those given up.
  Index count() const {
    const Index most = std::min(ask_, rows_ - done_);
    Index count = 1;
    while (count < most && !is_given_up(done_ + count)) ++count;
    return count;
  }

  /// True if the same row was given up before: it takes as long to find that out again.
  bool is_hopeless() const { return is_given_up(done_); }
  void skip() { ++done_; }

  void answered(Index rows) {
    if (rows == count()) ask_ = std::min(2 * ask_, rows_);
    done_ += rows;
    if (rows > 0) failures_ = 0;
  }

  /// True if the first row that is left is to be given up.
  bool gives_up(bool costly, bool declined) {
    const bool one = row_by_row_ || count() == 1, all = ask_ == rows_;
    const bool may_be_killed_from_outside = !declined && (one || (all && !costly));
    if (++failures_ == 1 && may_be_killed_from_outside) return false;
    failures_ = 0;
    if (one) {
      given_up_.push_back(done_);
      return true;
    }
    ask_ = (count() + 1) / 2;
    return false;
  }

 private:
  bool is_given_up(Index row) const {
    return std::ranges::any_of(
        given_up_, [&](Index other) { return X_.row(row) == X_.row(other) && U_.row(row) == U_.row(other); });
  }

  const ConstMatrixView &X_, &U_;
  std::vector<Index> given_up_;
  Index rows_, done_ = 0, ask_;
  Index failures_ = 0;  // of the same rows
  bool row_by_row_;
};

}  // namespace

Workers::~Workers() {
  std::vector<std::unique_ptr<Worker>> workers;
  while (auto worker = idle_.take()) workers.push_back(std::move(worker));
  for (const auto& worker : workers) worker->leave();
}

void Workers::change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const {
  std::unique_ptr<Worker> worker = idle_.take();
  for (RowsToAsk rows(X, U, options_.row_by_row); !rows.done();) {
    if (rows.is_hopeless()) {
      if (!still_patient_after(1)) worker = one_that_answers(std::move(worker), X, U, phi);
      dX.row(rows.first()).setConstant(kNaN);
      rows.skip();
      continue;
    }
    if (!worker) worker = options_.start();
    const Index first = rows.first(), count = rows.count();
    const Index answered =
        worker->change(X.middleRows(first, count), U.middleRows(first, count), phi, dX.middleRows(first, count));
    rows.answered(answered);
    if (answered > 0) remember(X.middleRows(first, 1), U.middleRows(first, 1), phi);
    if (answered == count) continue;
    const bool patient = note(*worker);
    const bool costly = worker->costly(), declined = worker->declined();
    if (!declined) worker.reset();
    if (!patient) worker = one_that_answers(std::move(worker), X, U, phi);
    if (!rows.gives_up(costly, declined)) continue;
    dX.row(rows.first()).setConstant(kNaN);
    rows.answered(1);
    if (!declined) lose();
  }
  idle_.give_back(std::move(worker));
}

Faults Workers::faults() const {
  const std::lock_guard lock(mutex_);
  return faults_;
}

Workers::KnownRows Workers::some_of(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi) {
  constexpr Index kSome = 4;
  const Index apart = (X.rows() + kSome - 1) / kSome, count = (X.rows() + apart - 1) / apart;
  const auto rows = Eigen::seqN(0, count, apart);
  return {X(rows, Eigen::all), U(rows, Eigen::all), phi};
}

void Workers::remember(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi) const {
  if (options_.patience == 0) return;
  const std::lock_guard lock(mutex_);
  faults_in_a_row_ = 0;
  if (!known_) known_ = {X, U, phi};
}

void Workers::lose() const {
  const std::lock_guard lock(mutex_);
  ++faults_.lost;
}

bool Workers::still_patient_after(Index faults) const {
  const std::lock_guard lock(mutex_);
  faults_in_a_row_ += faults;
  return options_.patience == 0 || faults_in_a_row_ < options_.patience;
}

bool Workers::note(const Worker& worker) const {
  {
    const std::lock_guard lock(mutex_);
    ++faults_.count;
    faults_.last = worker.problem();
  }
  return still_patient_after(worker.costly() ? kCostly : 1);
}

/// worker: to be asked first; null: none is left.
std::unique_ptr<Worker> Workers::one_that_answers(std::unique_ptr<Worker> worker, const ConstMatrixView& X,
                                                  const ConstMatrixView& U, const Vector& phi) const {
  std::optional<KnownRows> known;
  {
    const std::lock_guard lock(mutex_);
    known = known_;
  }
  if (!known) known = some_of(X, U, phi);
  std::string problem;
  for (Index i = 0; i < known->X.rows(); ++i) {
    if (!worker) worker = options_.start();
    Matrix dX(1, known->X.cols());
    if (worker->change(known->X.row(i), known->U.row(i), known->phi, dX) == 1) {
      remember(known->X.row(i), known->U.row(i), known->phi);
      return worker;
    }
    problem = worker->problem();
    if (!worker->declined()) worker.reset();
  }
  throw Unavailable(problem);
}

}  // namespace rehearse::system
