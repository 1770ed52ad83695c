#include "rehearse/identification/phi_posterior.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "rehearse/identification/coordinates.hpp"
#include "rehearse/identification/misfit.hpp"
#include "rehearse/identification/reach.hpp"

namespace rehearse::identification {
namespace {

constexpr double kBoxPrecision = 12;        // of a uniform distribution, in units of the box
constexpr double kErrors = 2;               // times those of derivatives by differences: less is not resolved
constexpr double kWeak = 0.1;               // deviation, as a fraction of the boxes, of a direction that is followed
constexpr double kTakesPart = 0.05;         // of a unit direction: the least component of a parameter that is
constexpr double kFar = 3.841458820694124;  // of a sum of squares, above its minimum: 95 % of one direction

/// An output's information about z near a point.
struct Told {
  Matrix factor;    // F (rows × q): the precision is Fᵀ F, which would lose directions that are hardly known
  Vector gradient;  // q, of the log evidence
  Matrix data;      // F of the data alone, without the misfit
};

/// Jᵀ C⁻¹ J and −Jᵀ C⁻¹ y, with C = K + extra Q Qᵀ and Q an orthonormal basis of the columns of J (n × q). NaN if it
/// cannot be computed.
Told told_by(const Matrix& J, const Vector& y, const Spread& spread, double extra) {
  const Eigen::JacobiSVD<Matrix> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Index rank = svd.rank(), q = J.cols();
  if (rank == 0) return {Matrix(0, q), Vector::Zero(q), Matrix(0, q)};
  const Matrix whitened = spread.whiten(svd.matrixU().leftCols(rank));
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(whitened.transpose() * whitened);
  if (!whitened.allFinite() || eigen.info() != Eigen::Success) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {Matrix::Constant(1, q, nan), Vector::Constant(q, nan), Matrix::Constant(1, q, nan)};
  }
  const Vector precisions = eigen.eigenvalues().cwiseMax(0);
  const Vector shrink = (1 + extra * precisions.array()).inverse();
  const Matrix turned =
      svd.matrixV().leftCols(rank) * svd.singularValues().head(rank).asDiagonal() * eigen.eigenvectors();
  const Vector pull = eigen.eigenvectors().transpose() * (whitened.transpose() * spread.whiten(y));
  return {shrink.cwiseProduct(precisions).cwiseSqrt().asDiagonal() * turned.transpose(),
          -turned * shrink.cwiseProduct(pull), precisions.cwiseSqrt().asDiagonal() * turned.transpose()};
}

Matrix stacked(const std::vector<Told>& all, Matrix Told::*which, Index q) {
  Matrix rows(0, q);
  for (const Told& told : all) {
    const Matrix& next = told.*which;
    rows.conservativeResize(rows.rows() + next.rows(), q);
    rows.bottomRows(next.rows()) = next;
  }
  return rows;
}

/// Directions of z (q × q), and the precision of each: that of the boxes, and of these factors what differences
/// resolve. `errors` is the Gram matrix of those of the whitened derivatives.
struct Directions {
  Matrix vectors;
  Vector precisions;
};
Directions directions_of(const Matrix& factor, const Matrix& errors) {
  const Index q = errors.cols();
  Matrix with_box(factor.rows() + q, q);
  with_box << factor, std::sqrt(kBoxPrecision) * Matrix::Identity(q, q);
  const Eigen::JacobiSVD<Matrix> svd(with_box, Eigen::ComputeThinV);
  const Matrix& V = svd.matrixV();
  const Vector unresolved = kErrors * kErrors * (V.transpose() * errors * V).diagonal();
  return {V, (svd.singularValues().cwiseAbs2() - unresolved).cwiseMax(kBoxPrecision)};
}

/// The covariance of z (q); where the search stopped short of the best z in the box, the way that is left counts as a
/// standard deviation. Empty if it cannot be computed.
Matrix covariance_of(const std::vector<Told>& all, const Matrix& errors, const Vector& z) {
  Vector gradient = Vector::Zero(z.size());
  for (const Told& told : all) gradient += told.gradient;
  const Matrix factor = stacked(all, &Told::factor, z.size());
  if (!factor.allFinite() || !gradient.allFinite() || !errors.allFinite()) return {};
  const Directions directions = directions_of(factor, errors);
  const Matrix root = directions.vectors * directions.precisions.cwiseSqrt().cwiseInverse().asDiagonal();
  const Matrix covariance = root * root.transpose();
  const Vector left = (z + covariance * gradient).cwiseMax(0).cwiseMin(1) - z;
  return covariance + left * left.transpose();
}

/// The directions (q × some) that the data alone leave to the boxes.
Matrix weak_directions(const std::vector<Told>& all, const Matrix& errors) {
  const Directions directions = directions_of(stacked(all, &Told::data, errors.cols()), errors);
  std::vector<Index> weak;
  for (Index k = 0; k < directions.precisions.size(); ++k)
    if (directions.precisions(k) < kBoxPrecision + 1 / (kWeak * kWeak)) weak.push_back(k);
  return directions.vectors(Eigen::all, weak);
}

using Arrange = std::function<Matrix(const Matrix&)>;

/// The residuals around a φ, with what is known of their spread. `arranged`: makes other outputs of them.
class Around {
 public:
  Around(const dynamics::Residuals& residuals, const prior::Prior& prior, const Vector& phi,
         const dynamics::Residuals::Rows& rows, const Evaluator& evaluator, Arrange arranged = {})
      : residuals_(residuals),
        prior_(prior),
        phi_(phi),
        rows_(rows),
        evaluator_(evaluator),
        coordinates_(prior.space, phi),
        arranged_(std::move(arranged)) {}

  /// Empty if a number is not finite.
  std::optional<PhiPosterior> posterior(const std::function<Spread(Index)>& spread_of,
                                        const PhiPosteriorOptions& options) {
    const Index q = coordinates_.size(), outputs = rows_.targets.cols();
    const Vector z = coordinates_.start();
    const PreciseSlopes slopes =
        precise_slopes([this](const Vector& other) { return targets(other); }, z, rows_.targets);
    std::vector<Told> told(static_cast<std::size_t>(outputs));
    std::vector<Matrix> errors(told.size());
    spreads_.resize(told.size());
    evaluator_.for_each(outputs, [&](Index e) {
      const auto k = static_cast<std::size_t>(e);
      const Matrix J = of_output(slopes.values, e);
      spreads_[k] = spread_of(e);
      const double extra = spreads_[k].misfit * static_cast<double>(J.rows()) / options.misfit_observations;
      told[k] = told_by(J, rows_.targets.col(e), spreads_[k], extra);
      const Matrix unresolved = spreads_[k].whiten(of_output(slopes.errors, e));
      errors[k] = unresolved.transpose() * unresolved;
    });
    const Matrix all_errors = std::accumulate(errors.begin(), errors.end(), Matrix(Matrix::Zero(q, q)));
    const Matrix covariance = covariance_of(told, all_errors, z);
    if (covariance.size() == 0 || !covariance.allFinite()) return {};
    const auto scale = coordinates_.widths().asDiagonal();
    PhiPosterior posterior{.mean = phi_(coordinates_.parameters()), .covariance = scale * covariance * scale};
    for (const Index i : coordinates_.parameters()) posterior.parameters.push_back(prior_.space[i]);
    follow(weak_directions(told, all_errors), posterior);
    return posterior;
  }

 private:
  Matrix targets(const Vector& z) const {
    Matrix all = residuals_.targets(&prior_, coordinates_.phi(z));
    if (!rows_.kept.empty()) all = Matrix(all(rows_.kept, Eigen::all));
    return arranged_ ? arranged_(all) : all;
  }

  static Matrix of_output(const std::vector<Matrix>& slopes, Index e) {
    Matrix J(slopes.front().rows(), static_cast<Index>(slopes.size()));
    for (Index i = 0; i < J.cols(); ++i) J.col(i) = slopes[static_cast<std::size_t>(i)].col(e);
    return J;
  }

  /// Columns of an output each, one output below the other.
  Matrix whitened(const std::function<Matrix(Index)>& of_output) const {
    std::vector<Matrix> parts(spreads_.size());
    evaluator_.for_each(static_cast<Index>(parts.size()), [&](Index e) {
      const auto k = static_cast<std::size_t>(e);
      parts[k] = spreads_[k].whiten(of_output(e));
    });
    const Index n = parts.front().rows();
    Matrix all(n * static_cast<Index>(parts.size()), parts.front().cols());
    for (std::size_t k = 0; k < parts.size(); ++k) all.middleRows(static_cast<Index>(k) * n, n) = parts[k];
    return all;
  }

  /// The whitened residuals as a function of z.
  optim::SquaresProblem problem() const {
    const auto errors = [this](const Vector& z) -> Vector {
      const Matrix at = targets(z);
      return whitened([&](Index e) { return Matrix(at.col(e)); });
    };
    const auto derivatives = [this](const Vector& z, const Vector&) {
      const auto all = slopes([this](const Vector& other) { return targets(other); }, z, targets(z));
      return whitened([&](Index e) { return of_output(all, e); });
    };
    return {errors, derivatives, Vector::Zero(coordinates_.size()), Vector::Ones(coordinates_.size())};
  }

  /// How far the parameters that take part in these directions get.
  void follow(const Matrix& directions, PhiPosterior& posterior) const {
    std::vector<Index> moved;
    for (Index i = 0; i < directions.rows(); ++i)
      if (directions.row(i).norm() > kTakesPart) moved.push_back(i);
    if (moved.empty()) return;
    Reach found = reach(problem(), coordinates_.start(), moved, kFar);
    const Vector &low = coordinates_.low(), &width = coordinates_.widths();
    for (const Index i : moved)
      if (auto& range = found.ranges[static_cast<std::size_t>(i)])
        range = {low(i) + width(i) * range->low, low(i) + width(i) * range->high};
    posterior.reach = std::move(found.ranges);
    posterior.alternatives = (width.asDiagonal() * found.points).colwise() + low;
    posterior.unknown_directions = directions.cols();
  }

  const dynamics::Residuals& residuals_;
  const prior::Prior& prior_;
  const Vector& phi_;
  const dynamics::Residuals::Rows& rows_;
  const Evaluator& evaluator_;
  const Coordinates coordinates_;
  const Arrange arranged_;
  std::vector<Spread> spreads_;
};

bool tunes_nothing(const prior::Prior* prior) {
  return !prior || prior->space.of_kind(Parameter::Kind::continuous).empty();
}

}  // namespace

std::vector<Interval> PhiPosterior::intervals() const {
  std::vector<Interval> all(parameters.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto i = static_cast<Index>(k);
    const double half = kNormal * std::sqrt(covariance(i, i));
    Interval range{mean(i) - half, mean(i) + half};
    if (!reach.empty() && reach[k]) range = {std::min(range.low, reach[k]->low), std::max(range.high, reach[k]->high)};
    all[k] = {std::max(parameters[k].box.low, range.low), std::min(parameters[k].box.high, range.high)};
  }
  return all;
}

std::optional<PhiPosterior> phi_posterior(const FitProblem& problem, const Fit& fit,
                                          const PhiPosteriorOptions& options) {
  if (tunes_nothing(problem.prior) || !std::isfinite(fit.score)) return {};
  const dynamics::Residuals::Rows rows = problem.residuals.at(problem.prior, fit.phi);
  if (!rows.inputs) return {};
  const auto spread_of = [&](Index e) {
    const gp::FitStart& kernel = fit.kernels[static_cast<std::size_t>(e)];
    return spread_of_gp(*rows.inputs, kernel.hyperparameters, rows.targets.col(e));
  };
  return Around(problem.residuals, *problem.prior, fit.phi, rows, problem.evaluator).posterior(spread_of, options);
}

std::optional<PhiPosterior> phi_posterior(const FitProblem& problem, const Fit& fit, const ErrorsInVariables& steps,
                                          const PhiPosteriorOptions& options) {
  if (tunes_nothing(problem.prior) || !std::isfinite(fit.score)) return {};
  const Vector units = misfits(problem, fit).cwiseSqrt();
  const auto in_units = [&](const Vector& r) { return Vector(r.cwiseQuotient(steps.repeated(units))); };
  const auto arranged = [&](const Matrix& targets) -> Matrix { return in_units(steps.residuals(targets)); };
  const auto whiten = [&](const Matrix& columns) {
    Matrix white(columns.rows(), columns.cols());
    for (Index i = 0; i < columns.cols(); ++i)
      white.col(i) = steps.whitened(columns.col(i).cwiseProduct(steps.repeated(units)));
    return white;
  };
  const dynamics::Residuals on_path = problem.residuals.of(steps.path());
  const dynamics::Residuals::Rows rows{
      .inputs = {}, .targets = arranged(on_path.targets(problem.prior, fit.phi)), .left_out = 0, .kept = {}};
  const auto spread_of = [&](Index) { return Spread{whiten, 1 / static_cast<double>(units.size())}; };
  return Around(on_path, *problem.prior, fit.phi, rows, problem.evaluator, arranged).posterior(spread_of, options);
}

std::optional<PhiPosterior> phi_posterior(const dynamics::Residuals& residuals, const prior::Prior& prior,
                                          const Vector& phi, const PhiPosteriorOptions& options,
                                          const Evaluator& evaluator) {
  if (tunes_nothing(&prior)) return {};
  const dynamics::Residuals::Rows rows = residuals.at(&prior, phi);
  if (!rows.inputs) return {};
  const auto parameters = static_cast<Index>(prior.space.of_kind(Parameter::Kind::continuous).size());
  const std::vector<Index> nearest = nearest_rows(*rows.inputs);
  const auto spread_of = [&](Index e) {
    return spread_of_white(rows.targets.col(e), residuals.scale()(e), parameters, nearest);
  };
  return Around(residuals, prior, phi, rows, evaluator).posterior(spread_of, options);
}

}  // namespace rehearse::identification
