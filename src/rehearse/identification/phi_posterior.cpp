#include "rehearse/identification/phi_posterior.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "rehearse/gp/evidence.hpp"
#include "rehearse/identification/coordinates.hpp"
#include "rehearse/identification/information.hpp"
#include "rehearse/identification/last_targets.hpp"
#include "rehearse/identification/misfit.hpp"
#include "rehearse/identification/reach.hpp"

namespace rehearse::identification {
namespace {

constexpr double kTakesPart = 0.05;         // of a unit direction: the least component of a parameter that is
constexpr double kFar = 3.841458820694124;  // of a sum of squares, above its minimum: 95 % of one direction

/// The targets (n × dx) at a φ, of the rows that count.
Matrix targets_of(LastTargets& targets, const dynamics::Residuals::Rows& rows, const Vector& phi) {
  Matrix all = targets.at(phi);
  if (rows.kept.empty()) return all;
  return all(rows.kept, Eigen::all);
}

/// The residuals of all outputs (n × dx) as one vector, and its covariance.
struct Stack {
  std::function<Vector(const Matrix&)> of;  // rows as a vector, linear
  std::function<Vector(const Vector& phi)> residuals;
  std::function<Matrix(const Matrix&)> whiten;  // columns that are such vectors
};

/// Independent outputs, one below the other. References must outlive it.
Stack independent(LastTargets& targets, const dynamics::Residuals::Rows& rows, const std::vector<Spread>& spreads,
                  const Evaluator& evaluator) {
  const auto of = [](const Matrix& all) -> Vector { return all.reshaped(); };
  const auto at = [&](const Vector& phi) -> Vector { return targets_of(targets, rows, phi).reshaped(); };
  const auto whiten = [&](const Matrix& columns) {
    const auto outputs = static_cast<Index>(spreads.size()), n = columns.rows() / outputs;
    Matrix white(columns.rows(), columns.cols());
    evaluator.for_each(outputs, [&](Index e) {
      const Spread& spread = spreads[static_cast<std::size_t>(e)];
      white.middleRows(e * n, n) = spread.whiten(columns.middleRows(e * n, n));
    });
    return white;
  };
  return {of, at, whiten};
}

/// The residuals around a φ, and their derivatives.
class Around {
 public:
  Around(LastTargets& targets, const Vector& phi, const dynamics::Residuals::Rows& rows,
         const std::vector<Spread>& spreads)
      : targets_(targets), phi_(phi), rows_(rows), spreads_(spreads), coordinates_(targets.prior().space, phi) {}

  std::optional<PhiPosterior> posterior(const Stack& stack, const PhiPosteriorOptions& options) const {
    const Vector z = coordinates_.start();
    const PreciseSlopes slopes =
        precise_slopes([this](const Vector& other) { return targets(other); }, z, rows_.targets);
    const Matrix J = stacked(stack, slopes.values);
    const NearResiduals near{stack.residuals(phi_), J, stacked(stack, slopes.errors), stack.whiten};
    const Information told = information(near, misfit(stack, slopes.values, options.misfit_observations));
    if (told.factor.size() == 0) return {};
    const Vector way = options.misfit_share * way_to_explain(J, explained(stack), deviations(stack), z);
    const Matrix covariance = covariance_of(told, z) + way * way.transpose();
    std::optional<PhiPosterior> posterior = posterior_of(covariance, targets_.prior().space, phi_);
    if (posterior) follow(weak_directions(told), stack, *posterior);
    return posterior;
  }

 private:
  Index outputs() const { return rows_.targets.cols(); }
  const Spread& spread(Index e) const { return spreads_[static_cast<std::size_t>(e)]; }

  Matrix targets(const Vector& z) const { return targets_of(targets_, rows_, coordinates_.phi(z)); }

  /// Derivatives (n × dx each) as columns.
  static Matrix stacked(const Stack& stack, const std::vector<Matrix>& slopes) {
    Matrix J(slopes.front().size(), static_cast<Index>(slopes.size()));
    for (Index i = 0; i < J.cols(); ++i) J.col(i) = stack.of(slopes[static_cast<std::size_t>(i)]);
    return J;
  }

  /// Each output's misfit, in all directions in which parameters move that output.
  Matrix misfit(const Stack& stack, const std::vector<Matrix>& slopes, double observations) const {
    const Index n = rows_.targets.rows();
    Matrix all(rows_.targets.size(), 0), J(n, static_cast<Index>(slopes.size()));
    for (Index e = 0; e < outputs(); ++e) {
      for (Index i = 0; i < J.cols(); ++i) J.col(i) = slopes[static_cast<std::size_t>(i)].col(e);
      const Matrix own = spread_over(J, spread(e).misfit * static_cast<double>(n) / observations);
      for (const auto& column : own.colwise()) {
        Matrix of_output = Matrix::Zero(n, outputs());
        of_output.col(e) = column;
        all.conservativeResize(Eigen::NoChange, all.cols() + 1);
        all.rightCols(1) = stack.of(of_output);
      }
    }
    return all;
  }

  /// The part of the residuals that GPs explain.
  Vector explained(const Stack& stack) const {
    Matrix all = Matrix::Zero(rows_.targets.rows(), outputs());
    for (Index e = 0; e < outputs(); ++e)
      if (spread(e).explained.size() > 0) all.col(e) = spread(e).explained;
    return stack.of(all);
  }

  Vector deviations(const Stack& stack) const {
    Matrix all(rows_.targets.rows(), outputs());
    for (Index e = 0; e < outputs(); ++e) {
      const double mean_square = rows_.targets.col(e).squaredNorm() / static_cast<double>(all.rows());
      all.col(e).setConstant(
          std::max(std::sqrt(mean_square), kLeastDeviation * gp::usable_scale(targets_.residuals().scale()(e))));
    }
    return stack.of(all);
  }

  /// The whitened residuals as a function of z.
  optim::SquaresProblem problem(const Stack& stack) const {
    const auto errors = [&](const Vector& z) -> Vector { return stack.whiten(stack.residuals(coordinates_.phi(z))); };
    const auto derivatives = [&](const Vector& z, const Vector&) {
      return stack.whiten(
          stacked(stack, slopes([this](const Vector& other) { return targets(other); }, z, targets(z))));
    };
    return {errors, derivatives, Vector::Zero(coordinates_.size()), Vector::Ones(coordinates_.size())};
  }

  /// Finds the ranges of the parameters that take part in these directions.
  void follow(const Matrix& directions, const Stack& stack, PhiPosterior& posterior) const {
    std::vector<Index> moved;
    for (Index i = 0; i < directions.rows(); ++i)
      if (directions.row(i).norm() > kTakesPart) moved.push_back(i);
    if (moved.empty()) return;
    Reach found = reach(problem(stack), coordinates_.start(), moved, kFar);
    const Vector &low = coordinates_.low(), &width = coordinates_.widths();
    for (const Index i : moved)
      if (auto& range = found.ranges[static_cast<std::size_t>(i)])
        range = {low(i) + width(i) * range->low, low(i) + width(i) * range->high};
    posterior.reach = std::move(found.ranges);
    posterior.alternatives = (width.asDiagonal() * found.points).colwise() + low;
    posterior.unknown_directions = directions.cols();
  }

  LastTargets& targets_;
  const Vector& phi_;
  const dynamics::Residuals::Rows& rows_;
  const std::vector<Spread>& spreads_;
  const Coordinates coordinates_;
};

bool tunes_nothing(const prior::Prior* prior) {
  return !prior || prior->space.of_kind(Parameter::Kind::continuous).empty();
}

/// The spread of each output around its GP.
std::vector<Spread> spreads_of_gps(const dynamics::Residuals::Rows& rows, const Fit& fit, const Evaluator& evaluator) {
  std::vector<Spread> all(fit.kernels.size());
  evaluator.for_each(rows.targets.cols(), [&](Index e) {
    const auto k = static_cast<std::size_t>(e);
    all[k] = spread_of_gp(*rows.inputs, fit.kernels[k].hyperparameters, rows.targets.col(e));
  });
  return all;
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

std::optional<PhiPosterior> posterior_of(const Matrix& covariance, const ParameterSpace& space, const Vector& phi) {
  const Coordinates coordinates(space, phi);
  const Index q = coordinates.size();
  if (q == 0 || !covariance.allFinite()) return {};
  const auto scale = coordinates.widths().asDiagonal();
  PhiPosterior posterior{.mean = phi(coordinates.parameters()),
                         .covariance = scale * covariance.topLeftCorner(q, q) * scale};
  for (const Index i : coordinates.parameters()) posterior.parameters.push_back(space[i]);
  return posterior;
}

std::optional<PhiPosterior> phi_posterior(const FitProblem& problem, const Fit& fit,
                                          const PhiPosteriorOptions& options) {
  if (tunes_nothing(problem.prior) || !std::isfinite(fit.score)) return {};
  const dynamics::Residuals::Rows rows = problem.residuals.at(problem.prior, fit.phi);
  if (!rows.inputs) return {};
  const std::vector<Spread> spreads = spreads_of_gps(rows, fit, problem.evaluator);
  LastTargets targets(problem.residuals, *problem.prior);
  return Around(targets, fit.phi, rows, spreads)
      .posterior(independent(targets, rows, spreads, problem.evaluator), options);
}

std::optional<PhiPosterior> phi_posterior(const FitProblem& problem, const Fit& fit, const ErrorsInVariables& steps,
                                          const PhiPosteriorOptions& options) {
  if (tunes_nothing(problem.prior) || !std::isfinite(fit.score)) return {};
  const dynamics::Residuals::Rows rows = problem.residuals.at(problem.prior, fit.phi);
  if (!rows.inputs || !rows.kept.empty()) return {};
  const dynamics::Residuals on_path = problem.residuals.of(steps.path());
  const auto whiten = [&](const Matrix& columns) {
    Matrix white(columns.rows(), columns.cols());
    for (Index i = 0; i < columns.cols(); ++i) white.col(i) = steps.whitened(columns.col(i));
    return white;
  };
  const Stack stack{[&](const Matrix& all) { return steps.stacked(all); },
                    [&](const Vector& phi) { return steps.residuals(on_path.targets(problem.prior, phi)); }, whiten};
  const std::vector<Spread> spreads = spreads_of_gps(rows, fit, problem.evaluator);
  LastTargets targets(problem.residuals, *problem.prior);
  return Around(targets, fit.phi, rows, spreads).posterior(stack, options);
}

std::optional<PhiPosterior> phi_posterior(const dynamics::Residuals& residuals, const prior::Prior& prior,
                                          const Vector& phi, double misfit_observations, const Evaluator& evaluator) {
  if (tunes_nothing(&prior)) return {};
  const dynamics::Residuals::Rows rows = residuals.at(&prior, phi);
  if (!rows.inputs) return {};
  const auto parameters = static_cast<Index>(prior.space.of_kind(Parameter::Kind::continuous).size());
  const std::vector<Index> nearest = nearest_rows(*rows.inputs);
  std::vector<Spread> spreads;
  for (Index e = 0; e < rows.targets.cols(); ++e)
    spreads.push_back(spread_of_white(rows.targets.col(e), residuals.scale()(e), parameters, nearest));
  LastTargets targets(residuals, prior);
  return Around(targets, phi, rows, spreads)
      .posterior(independent(targets, rows, spreads, evaluator),
                 {.misfit_observations = misfit_observations, .misfit_share = 0});
}

}  // namespace rehearse::identification
