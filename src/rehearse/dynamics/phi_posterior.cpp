#include "rehearse/dynamics/phi_posterior.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/dynamics/coordinates.hpp"
#include "rehearse/gp/evidence.hpp"

namespace rehearse::dynamics {
namespace {

constexpr double kNormal = 1.959963984540054;  // standard deviations of a normal distribution hold 95 % on both sides
constexpr double kBoxPrecision = 12;           // of a uniform distribution, in units of the box
constexpr double kLeastDeviation = 1e-6;       // of white residuals, as a fraction of the changes: gp::Bounds' floor
constexpr double kUnsure = 0.1;                // half an interval that is worth a sentence, as a fraction of the box
constexpr double kOthersKnown = 0.3;  // of a deviation is left once the others are known: they cannot be told apart.
                                      // Of two parameters that is a correlation of 0.95
constexpr double kLinked = 0.5;       // correlation of those that are named together
constexpr double kAtEnd = 1e-3;       // of the box

/// An output's residuals y: their covariance K = L Lᵀ and their misfit.
struct Spread {
  std::function<Matrix(const Matrix&)> whiten;  // L⁻¹
  double misfit;                                // mean square, of a GP a degree of freedom
};

/// Mean square of y less that of its errors of leave-one-out predictions (Rasmussen 2006, eq. 5.12), a degree of
/// freedom of the GP, which has the trace of (K − σ_n² I) K⁻¹.
double predictable(const gp::Whitening& whiten, const ConstVectorView& y, double noise_variance) {
  const Matrix inverse_factor = whiten(Matrix::Identity(y.size(), y.size()));
  const Vector weights = inverse_factor.transpose() * whiten(y).col(0);
  const Vector precisions = inverse_factor.colwise().squaredNorm();
  const double errors = weights.cwiseQuotient(precisions).squaredNorm();
  const auto n = static_cast<double>(y.size());
  const double freedom = std::max(1.0, n - noise_variance * precisions.sum());
  return std::max(0.0, y.squaredNorm() - errors) / (n * freedom);
}

Spread spread_of_gp(const gp::Inputs& inputs, const gp::Hyperparameters& kernel, const ConstVectorView& y) {
  gp::Whitening whiten(inputs, kernel);
  const double misfit = predictable(whiten, y, kernel.noise_variance());
  return {std::move(whiten), misfit};
}

/// Mean squares a degree of freedom, one an output, positive.
Vector misfits(const Estimation& estimation, const Estimate& estimate) {
  const Residuals::Rows rows = estimation.residuals.at(estimation.prior, estimate.phi);
  Vector all(rows.targets.cols());
  estimation.evaluator.for_each(all.size(), [&](Index e) {
    const double floor = std::pow(kLeastDeviation * gp::usable_scale(estimation.residuals.scale()(e)), 2);
    const gp::FitStart& kernel = estimate.kernels[static_cast<std::size_t>(e)];
    all(e) = std::max(floor, spread_of_gp(*rows.inputs, kernel.hyperparameters, rows.targets.col(e)).misfit);
  });
  return all;
}

/// The row nearest to each in the space of the inputs, of equals the first; of a single row itself.
std::vector<Index> nearest_rows(const gp::Inputs& inputs) {
  const Matrix X = (inputs.unit() * inputs.half_range().cwiseQuotient(inputs.spread()).asDiagonal()).transpose();
  std::vector<Index> nearest(static_cast<std::size_t>(X.cols()));
  for (Index i = 0; i < X.cols(); ++i) {
    Vector distances = (X.colwise() - X.col(i)).colwise().squaredNorm();
    distances(i) = std::numeric_limits<double>::infinity();
    distances.minCoeff(&nearest[static_cast<std::size_t>(i)]);
  }
  return nearest;
}

/// Of y that is white around a smooth function of the inputs: half the mean squared difference of nearest rows is the
/// variance of what is white (the delta test; Pi and Peterson 1994).
Spread spread_of_white(const ConstVectorView& y, double scale, Index parameters, const std::vector<Index>& nearest) {
  const double n = static_cast<double>(y.size());
  const double floor = kLeastDeviation * gp::usable_scale(scale);
  const double variance = y.squaredNorm() / std::max(n - static_cast<double>(parameters), 1.0);
  const double deviation = std::sqrt(std::max(variance, floor * floor));
  const double white = 0.5 * (y - y(nearest)).squaredNorm();
  return {[deviation](const Matrix& Y) { return Matrix(Y / deviation); }, std::max(0.0, y.squaredNorm() - white) / n};
}

/// What an output says of z near a point: the precision, and the gradient of its log evidence.
struct Told {
  Matrix precision;
  Vector gradient;
};

/// Jᵀ C⁻¹ J and −Jᵀ C⁻¹ y, with C = K + extra Q Qᵀ and Q an orthonormal basis of the columns of J (n × q). NaN if it
/// cannot be computed.
Told told_by(const Matrix& J, const Vector& y, const Spread& spread, double extra) {
  const Eigen::JacobiSVD<Matrix> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Index rank = svd.rank();
  if (rank == 0) return {Matrix::Zero(J.cols(), J.cols()), Vector::Zero(J.cols())};
  const Matrix whitened = spread.whiten(svd.matrixU().leftCols(rank));
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(whitened.transpose() * whitened);
  if (!whitened.allFinite() || eigen.info() != Eigen::Success) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {Matrix::Constant(J.cols(), J.cols(), nan), Vector::Constant(J.cols(), nan)};
  }
  const Vector precisions = eigen.eigenvalues().cwiseMax(0);
  const Vector shrink = (1 + extra * precisions.array()).inverse();
  const Matrix turned =
      svd.matrixV().leftCols(rank) * svd.singularValues().head(rank).asDiagonal() * eigen.eigenvectors();
  const Vector pull = eigen.eigenvectors().transpose() * (whitened.transpose() * spread.whiten(y));
  return {turned * shrink.cwiseProduct(precisions).asDiagonal() * turned.transpose(),
          -turned * shrink.cwiseProduct(pull)};
}

/// Of z (q); where the search stopped short of the best z in the box, the way that is left counts as a standard
/// deviation. Empty if it cannot be computed.
Matrix covariance_of(const std::vector<Told>& all, const Vector& z) {
  const Index q = z.size();
  Matrix precision = kBoxPrecision * Matrix::Identity(q, q);
  Vector gradient = Vector::Zero(q);
  for (const Told& told : all) precision += told.precision, gradient += told.gradient;
  const Eigen::LLT<Matrix> factor(precision);
  if (!precision.allFinite() || factor.info() != Eigen::Success) return {};
  const Vector left = (z + factor.solve(gradient)).cwiseMax(0).cwiseMin(1) - z;
  return factor.solve(Matrix::Identity(q, q)) + left * left.transpose();
}

/// The posterior around φ, given what is known of each output's residuals. `arranged`: makes other outputs of them.
std::optional<PhiPosterior> posterior_of(const Residuals& residuals, const prior::Prior& prior, const Vector& phi,
                                         const Residuals::Rows& rows, const std::function<Spread(Index)>& spread_of,
                                         const PhiPosteriorOptions& options, const Evaluator& evaluator,
                                         const std::function<Matrix(const Matrix&)>& arranged = {}) {
  const Coordinates coordinates(prior.space, phi);
  const Index q = coordinates.size(), outputs = rows.targets.cols();
  const auto targets = [&](const Vector& z) -> Matrix {
    Matrix all = residuals.targets(&prior, coordinates.phi(z));
    if (!rows.kept.empty()) all = Matrix(all(rows.kept, Eigen::all));
    return arranged ? arranged(all) : all;
  };
  const auto derivatives = slopes(targets, coordinates.start(), rows.targets);
  std::vector<Told> told(static_cast<std::size_t>(outputs));
  evaluator.for_each(outputs, [&](Index e) {
    Matrix J(rows.targets.rows(), q);
    for (Index i = 0; i < q; ++i) J.col(i) = derivatives[static_cast<std::size_t>(i)].col(e);
    const Spread spread = spread_of(e);
    const double extra = spread.misfit * static_cast<double>(J.rows()) / options.misfit_observations;
    told[static_cast<std::size_t>(e)] = told_by(J, rows.targets.col(e), spread, extra);
  });
  const Matrix covariance = covariance_of(told, coordinates.start());
  if (covariance.size() == 0 || !covariance.allFinite()) return {};
  const auto scale = coordinates.widths().asDiagonal();
  PhiPosterior posterior{.mean = phi(coordinates.parameters()), .covariance = scale * covariance * scale};
  for (const Index i : coordinates.parameters()) posterior.parameters.push_back(prior.space[i]);
  return posterior;
}

bool tunes_nothing(const prior::Prior* prior) {
  return !prior || prior->space.of_kind(Parameter::Kind::continuous).empty();
}

double width(const Interval& box) { return box.high - box.low; }

/// About parameters that the data cannot tell apart, or one that could be anything in a range.
std::string doubt(const std::vector<std::string>& names, const Interval& range) {
  if (names.size() == 1)
    return fmt::format("{} is not determined by these trials: {:.3g} to {:.3g}", names.front(), range.low, range.high);
  return fmt::format("{} and {} cannot be told apart by these trials", fmt::join(names.begin(), names.end() - 1, ", "),
                     names.back());
}

Matrix correlations(const Matrix& covariance) {
  const Vector inverse = covariance.diagonal().cwiseSqrt().cwiseInverse();
  return inverse.asDiagonal() * covariance * inverse.asDiagonal();
}

/// These parameters in groups: those that the data cannot tell apart together, each of the others alone.
std::vector<std::vector<Index>> groups_of(std::vector<Index> parameters, const Matrix& covariance) {
  const Matrix precision = covariance.llt().solve(Matrix::Identity(covariance.rows(), covariance.cols()));
  const Matrix links = correlations(covariance).cwiseAbs().cwiseMax(correlations(precision).cwiseAbs());
  const auto needs_others = [&](Index i) {
    return 1 / (covariance(i, i) * precision(i, i)) < kOthersKnown * kOthersKnown;
  };
  std::vector<std::vector<Index>> groups;
  while (!parameters.empty()) {
    std::vector<Index> group{parameters.front()};
    parameters.erase(parameters.begin());
    for (std::size_t i = 0; i < group.size(); ++i) {
      const auto apart = [&, from = group[i]](Index to) {
        return !needs_others(from) || !needs_others(to) || links(from, to) < kLinked;
      };
      const auto linked = std::stable_partition(parameters.begin(), parameters.end(), apart);
      group.insert(group.end(), linked, parameters.end());
      parameters.erase(linked, parameters.end());
    }
    std::sort(group.begin(), group.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace

std::vector<Interval> PhiPosterior::intervals() const {
  std::vector<Interval> all(parameters.size());
  for (Index i = 0; i < mean.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double half = kNormal * std::sqrt(covariance(i, i));
    all[k] = {std::max(parameters[k].box.low, mean(i) - half), std::min(parameters[k].box.high, mean(i) + half)};
  }
  return all;
}

std::vector<std::string> PhiPosterior::doubts() const {
  const auto of = [&](Index i) -> const Parameter& { return parameters[static_cast<std::size_t>(i)]; };
  std::vector<Index> unsure;
  for (Index i = 0; i < mean.size(); ++i)
    if (kNormal * std::sqrt(covariance(i, i)) > kUnsure * width(of(i).box)) unsure.push_back(i);
  std::vector<std::string> sentences;
  const std::vector<Interval> ranges = intervals();
  for (const std::vector<Index>& group : groups_of(unsure, covariance)) {
    std::vector<std::string> names;
    for (const Index i : group) names.push_back(of(i).name);
    sentences.push_back(doubt(names, ranges[static_cast<std::size_t>(group.front())]));
  }
  for (Index i = 0; i < mean.size(); ++i)
    for (const double end : {of(i).box.low, of(i).box.high})
      if (std::abs(mean(i) - end) <= kAtEnd * width(of(i).box))
        sentences.push_back(
            fmt::format("{} is at the end of its box, {:.3g}: a better value may lie beyond", of(i).name, end));
  return sentences;
}

std::optional<PhiPosterior> phi_posterior(const Estimation& estimation, const Estimate& estimate,
                                          const PhiPosteriorOptions& options) {
  if (tunes_nothing(estimation.prior) || !std::isfinite(estimate.score)) return {};
  const Residuals::Rows rows = estimation.residuals.at(estimation.prior, estimate.phi);
  if (!rows.inputs) return {};
  const auto spread_of = [&](Index e) {
    const gp::FitStart& kernel = estimate.kernels[static_cast<std::size_t>(e)];
    return spread_of_gp(*rows.inputs, kernel.hyperparameters, rows.targets.col(e));
  };
  return posterior_of(estimation.residuals, *estimation.prior, estimate.phi, rows, spread_of, options,
                      estimation.evaluator);
}

std::optional<PhiPosterior> phi_posterior(const Estimation& estimation, const Estimate& estimate,
                                          const ErrorsInVariables& steps, const PhiPosteriorOptions& options) {
  if (tunes_nothing(estimation.prior) || !std::isfinite(estimate.score)) return {};
  const Vector units = misfits(estimation, estimate).cwiseSqrt();
  const auto in_units = [&](const Vector& r) { return Vector(r.cwiseQuotient(steps.repeated(units))); };
  const auto arranged = [&](const Matrix& targets) -> Matrix { return in_units(steps.residuals(targets)); };
  const auto whiten = [&](const Matrix& columns) {
    Matrix white(columns.rows(), columns.cols());
    for (Index i = 0; i < columns.cols(); ++i)
      white.col(i) = steps.whitened(columns.col(i).cwiseProduct(steps.repeated(units)));
    return white;
  };
  const Residuals on_path = estimation.residuals.of(steps.path());
  const Residuals::Rows rows{
      .inputs = {}, .targets = arranged(on_path.targets(estimation.prior, estimate.phi)), .left_out = 0, .kept = {}};
  const auto spread_of = [&](Index) { return Spread{whiten, 1 / static_cast<double>(units.size())}; };
  return posterior_of(on_path, *estimation.prior, estimate.phi, rows, spread_of, options, estimation.evaluator,
                      arranged);
}

std::optional<PhiPosterior> phi_posterior(const Residuals& residuals, const prior::Prior& prior, const Vector& phi,
                                          const PhiPosteriorOptions& options, const Evaluator& evaluator) {
  if (tunes_nothing(&prior)) return {};
  const Residuals::Rows rows = residuals.at(&prior, phi);
  if (!rows.inputs) return {};
  const auto parameters = static_cast<Index>(prior.space.of_kind(Parameter::Kind::continuous).size());
  const std::vector<Index> nearest = nearest_rows(*rows.inputs);
  const auto spread_of = [&](Index e) {
    return spread_of_white(rows.targets.col(e), residuals.scale()(e), parameters, nearest);
  };
  return posterior_of(residuals, prior, phi, rows, spread_of, options, evaluator);
}

}  // namespace rehearse::dynamics
