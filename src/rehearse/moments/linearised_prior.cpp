#include "rehearse/moments/linearised_prior.hpp"

#include "rehearse/moments/prior_differences.hpp"

namespace rehearse::moments {
namespace {

// The points: the mean, then for each input one with less of it and one with more.
Index less_of(Index input) { return 1 + 2 * input; }
Index more_of(Index input) { return 2 + 2 * input; }

/// Calls visit(j, k, row) for each pair of inputs: at `row` the neighbour has less of both, at row + 1 more.
template <class Visit>
void for_each_pair(Index inputs, Visit visit) {
  Index row = 0;
  for (Index k = 1; k < inputs; ++k)
    for (Index j = 0; j < k; ++j, row += 2) visit(j, k, row);
}

}  // namespace

bool LinearisedPrior::place(const Gaussian& input, PriorTape& tape) const {
  const Index n = inputs();
  tape.directions = input.mean.unaryExpr(&second_step).asDiagonal();
  tape.points.resize(1 + 2 * n, n);
  tape.points.rowwise() = input.mean.transpose();
  for (Index j = 0; j < n; ++j) {
    tape.points(less_of(j), j) -= tape.directions(j, j);
    tape.points(more_of(j), j) += tape.directions(j, j);
  }
  return true;
}

void LinearisedPrior::combine(const PriorTape& tape, Transformed& change) const {
  change = Transformed::zero(inputs(), states());
  change.mean = tape.changes.row(0).transpose();
  for (Index j = 0; j < inputs(); ++j)
    change.gain.row(j) = (tape.changes.row(more_of(j)) - tape.changes.row(less_of(j))) / (2 * tape.directions(j, j));
}

void LinearisedPrior::place_neighbours(const PriorTape& tape, MatrixView neighbours) const {
  neighbours.rowwise() = tape.points.row(0);
  for_each_pair(inputs(), [&](Index j, Index k, Index row) {
    for (const Index input : {j, k}) {
      neighbours(row, input) -= tape.directions(input, input);
      neighbours(row + 1, input) += tape.directions(input, input);
    }
  });
}

/// The gain's rows are slopes, whose slopes are second derivatives: for j ≠ k
/// (f₊₊ + f₋₋ − f₊₀ − f₋₀ − f₀₊ − f₀₋ + 2 f₀₀) / (2 h_j h_k), with f₊₀ beyond j alone.
void LinearisedPrior::combine_adjoint(const PriorTape& tape, const Transformed& change, const Transformed& adjoint,
                                      Gaussian& input_adjoint) const {
  const auto at_mean = tape.changes.row(0);
  const auto bend = [&](Index j) {
    return (tape.changes.row(less_of(j)) + tape.changes.row(more_of(j)) - 2 * at_mean).eval();
  };
  input_adjoint.mean += change.gain * adjoint.mean;
  for (Index j = 0; j < inputs(); ++j) {
    const double h = tape.directions(j, j);
    input_adjoint.mean(j) += adjoint.gain.row(j).dot(bend(j)) / (h * h);
  }
  for_each_pair(inputs(), [&](Index j, Index k, Index row) {
    const Matrix second = (tape.nearby.row(row) + tape.nearby.row(row + 1) - 2 * at_mean - bend(j) - bend(k)) /
                          (2 * tape.directions(j, j) * tape.directions(k, k));
    input_adjoint.mean(j) += adjoint.gain.row(k).dot(second.row(0));
    input_adjoint.mean(k) += adjoint.gain.row(j).dot(second.row(0));
  });
}

}  // namespace rehearse::moments
