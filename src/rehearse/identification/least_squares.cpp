#include "rehearse/identification/least_squares.hpp"

#include <cmath>

#include "rehearse/gp/bounds.hpp"
#include "rehearse/identification/coordinates.hpp"
#include "rehearse/identification/last_targets.hpp"
#include "rehearse/optim/least_squares.hpp"
#include "rehearse/optim/spread.hpp"

namespace rehearse::identification {
namespace {

constexpr double kExact = 1e-24;  // mean squared error, as a fraction of the changes' variance

/// One-step errors as a function of φ. A row that fails has errors as large as the largest ones at the start, and at
/// least as large as the changes' standard deviations: a φ at which all rows fail is no better than the start.
class OneStepErrors {
 public:
  OneStepErrors(const dynamics::Residuals& residuals, const prior::Prior& prior, const Vector& start)
      : targets_(residuals, prior), charge_(residuals.scale().unaryExpr(&gp::usable_scale)) {
    const Matrix errors = targets_.at(start);
    for (Index i = 0; i < errors.rows(); ++i)
      if (errors.row(i).allFinite()) charge_ = charge_.cwiseMax(errors.row(i).transpose().cwiseAbs());
  }

  Matrix at(const Vector& phi) { return charged(targets_.at(phi)); }

  /// Their derivatives (rows × outputs, one below the other): 0 for a row that fails at one end of a difference.
  Matrix slopes(const Coordinates& coordinates, const Vector& z) {
    const Matrix here = targets_.at(coordinates.phi(z)), charged_here = charged(here);
    const auto there = [&](const Vector& other) {
      Matrix errors = targets_.at(coordinates.phi(other));
      for (Index i = 0; i < errors.rows(); ++i)
        if (!errors.row(i).allFinite() || !here.row(i).allFinite()) errors.row(i) = charged_here.row(i);
      return errors;
    };
    const std::vector<Matrix> all = identification::slopes(there, z, charged_here);
    Matrix J(here.size(), z.size());
    for (Index i = 0; i < z.size(); ++i) J.col(i) = all[static_cast<std::size_t>(i)].reshaped();
    return J;
  }

  /// Minus the mean of a sum of squares over the rows.
  double score(double squares) const { return -squares / rows(); }
  double negligible() const { return kExact * rows() * targets_.residuals().scale().squaredNorm(); }
  Index evaluations() const { return targets_.evaluations(); }

 private:
  double rows() const { return static_cast<double>(targets_.residuals().size()); }
  Matrix charged(Matrix errors) const {
    for (Index i = 0; i < errors.rows(); ++i)
      if (!errors.row(i).allFinite()) errors.row(i) = charge_.transpose();
    return errors;
  }

  LastTargets targets_;
  Vector charge_;  // of each output
};

/// Searches φ for one combination of the discrete parameters, by descents from several starts.
class Descents {
 public:
  Descents(OneStepErrors& errors, Coordinates coordinates, const LeastSquares& options)
      : errors_(errors), coordinates_(std::move(coordinates)), options_(options) {
    const Index q = coordinates_.size();
    problem_ = {[this](const Vector& z) -> Vector { return errors_.at(coordinates_.phi(z)).reshaped(); },
                [this](const Vector& z, const Vector&) { return errors_.slopes(coordinates_, z); }, Vector::Zero(q),
                Vector::Ones(q), errors_.negligible()};
  }

  /// φ and its score.
  Identified run() {
    const Vector first = coordinates_.start();
    best_ = optim::minimise_squares(problem_, first);
    for (Index i = 1; i < options_.starts && best_.value > problem_.negligible; ++i)
      consider(optim::minimise_squares(problem_, optim::spread_point(first.size(), i)));
    if (!best_.converged && std::isfinite(best_.value)) search();
    return {coordinates_.phi(best_.x), errors_.score(best_.value), errors_.evaluations()};
  }

 private:
  void consider(const optim::SquaresResult& found) {
    if (found.value < best_.value) best_ = found;
  }

  /// Searches by Subplex, where derivatives mislead.
  void search() {
    const std::vector<Interval> box(static_cast<std::size_t>(best_.x.size()), {0, 1});
    const auto score = [&](const Vector& z) { return -problem_.errors(z).squaredNorm(); };
    const auto found = optim::maximise_subplex(score, best_.x, box, options_.subplex);
    consider(optim::minimise_squares(problem_, found.x));
  }

  OneStepErrors& errors_;
  const Coordinates coordinates_;
  const LeastSquares& options_;
  optim::SquaresProblem problem_;
  optim::SquaresResult best_;
};

}  // namespace

Identified least_squares(const dynamics::Residuals& residuals, const prior::Prior& prior,
                         const std::optional<Vector>& start, const LeastSquares& options) {
  Vector phi = start.value_or(prior.space.values());
  OneStepErrors errors(residuals, prior, phi);
  const auto score = [&](const Vector& phi) { return errors.score(errors.at(phi).squaredNorm()); };
  const bool continuous = !prior.space.of_kind(Parameter::Kind::continuous).empty();
  if (options.method == LeastSquares::Method::subplex || !continuous)
    return identify(prior.space, start, score, options.subplex);
  const std::vector<Index> discrete = prior.space.of_kind(Parameter::Kind::discrete);
  Identified best{.phi = phi, .score = -kInf};
  for (const Vector& choice : choices_of(prior.space, discrete)) {
    phi(discrete) = choice;
    const Identified found = Descents(errors, Coordinates(prior.space, phi), options).run();
    if (found.score > best.score) best.score = found.score, best.phi = found.phi;
  }
  best.evaluations = errors.evaluations();
  return best;
}

}  // namespace rehearse::identification
