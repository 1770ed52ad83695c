#include "rehearse/moments/unscented_prior.hpp"

#include <cmath>

#include <Eigen/Cholesky>

#include "rehearse/moments/prior_differences.hpp"

namespace rehearse::moments {
namespace {

// The rows of a point on either side of the mean along a direction, and of its neighbours with less and more of an
// input.
Index below(Index direction) { return 2 * direction; }
Index above(Index direction) { return 2 * direction + 1; }
Index less_of(Index point, Index input, Index inputs) { return 2 * (point * inputs + input); }
Index more_of(Index point, Index input, Index inputs) { return less_of(point, input, inputs) + 1; }

/// The halves of the differences (first) and sums (second) of what the prior answered on both sides, a row each
/// direction.
std::pair<Matrix, Matrix> halves(const PriorTape& tape) {
  const Index n = tape.directions.cols(), dx = tape.changes.cols();
  Matrix differences(n, dx), sums(n, dx);
  for (Index k = 0; k < n; ++k) {
    differences.row(k) = (tape.changes.row(above(k)) - tape.changes.row(below(k))) / 2;
    sums.row(k) = (tape.changes.row(above(k)) + tape.changes.row(below(k))) / 2;
  }
  return {std::move(differences), std::move(sums)};
}

/// The adjoint of B Bᵀ by that of B (Murray 2016, "Differentiation of the Cholesky decomposition", eq. 10).
Matrix factor_adjoint(const Matrix& B, const Matrix& by_factor) {
  Matrix inner = (B.transpose() * by_factor).triangularView<Eigen::Lower>();
  inner.diagonal() /= 2;
  const auto upper = B.transpose().triangularView<Eigen::Upper>();
  const Matrix half = upper.solve(inner);
  const Matrix by = upper.solve(half.transpose());
  return (by + by.transpose()) / 2;
}

}  // namespace

bool UnscentedPrior::place(const Gaussian& input, PriorTape& tape) const {
  const Index n = inputs();
  Matrix widened = input.covariance;
  widened.diagonal() += input.mean.unaryExpr(&first_step).cwiseAbs2();
  const Eigen::LLT<Matrix> factor(widened);
  if (factor.info() != Eigen::Success) return false;
  tape.directions = factor.matrixL();
  const double reach = std::sqrt(static_cast<double>(n));
  tape.points.resize(2 * n, n);
  for (Index k = 0; k < n; ++k) {
    const Vector step = reach * tape.directions.col(k);
    tape.points.row(below(k)) = (input.mean - step).transpose();
    tape.points.row(above(k)) = (input.mean + step).transpose();
  }
  return true;
}

/// With B the directions: gain = B⁻ᵀ O / √n, O the half differences.
void UnscentedPrior::combine(const PriorTape& tape, Transformed& change) const {
  const auto [differences, sums] = halves(tape);
  const double n = static_cast<double>(inputs());
  const auto upper = tape.directions.transpose().triangularView<Eigen::Upper>();
  change.gain = upper.solve(differences) / std::sqrt(n);
  change.mean = sums.colwise().mean().transpose();
  const Matrix apart = sums.rowwise() - change.mean.transpose();
  change.covariance = apart.transpose() * apart / n;
}

void UnscentedPrior::place_neighbours(const PriorTape& tape, MatrixView neighbours) const {
  const Index n = inputs();
  for (Index p = 0; p < tape.points.rows(); ++p)
    for (Index j = 0; j < n; ++j) {
      const double h = first_step(tape.points(p, j));
      neighbours.row(less_of(p, j, n)) = tape.points.row(p);
      neighbours.row(more_of(p, j, n)) = tape.points.row(p);
      neighbours(less_of(p, j, n), j) -= h;
      neighbours(more_of(p, j, n), j) += h;
    }
}

void UnscentedPrior::combine_adjoint(const PriorTape& tape, const Transformed& change, const Transformed& adjoint,
                                     Gaussian& input_adjoint) const {
  const Index n = inputs();
  const double count = static_cast<double>(n), reach = std::sqrt(count);
  const Matrix& B = tape.directions;
  const Matrix sums = halves(tape).second;
  const Matrix apart = sums.rowwise() - change.mean.transpose();
  const Matrix by_differences = B.triangularView<Eigen::Lower>().solve(adjoint.gain) / reach;
  Matrix by_sums = 2 * apart * adjoint.covariance / count;
  by_sums.rowwise() += adjoint.mean.transpose() / count;
  Matrix by_directions = -reach * change.gain * by_differences.transpose();

  const auto point_adjoint = [&](Index p, const Eigen::RowVectorXd& by_change) {
    return Vector::NullaryExpr(n,
                               [&](Index j) {
                                 const Index less = less_of(p, j, n), more = more_of(p, j, n);
                                 const double width = tape.neighbours(more, j) - tape.neighbours(less, j);
                                 return by_change.dot(tape.nearby.row(more) - tape.nearby.row(less)) / width;
                               })
        .eval();
  };
  for (Index k = 0; k < n; ++k) {
    const Vector of_below = point_adjoint(below(k), (by_sums.row(k) - by_differences.row(k)) / 2);
    const Vector of_above = point_adjoint(above(k), (by_sums.row(k) + by_differences.row(k)) / 2);
    input_adjoint.mean += of_below + of_above;
    by_directions.col(k) += reach * (of_above - of_below);
  }
  input_adjoint.covariance += factor_adjoint(B, by_directions);
}

}  // namespace rehearse::moments
