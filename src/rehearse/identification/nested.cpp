#include "rehearse/identification/nested.hpp"

#include <cmath>
#include <utility>

#include "rehearse/identification/least_squares.hpp"
#include "rehearse/identification/parameter_search.hpp"

namespace rehearse::identification {
namespace {

class NestedSearch {
 public:
  explicit NestedSearch(const FitProblem& problem) : problem_(problem) {}

  Fit run(const GpMi& kind, const WarmStart& start) {
    const prior::Prior& prior = *problem_.prior;
    const Vector phi = start.phi.value_or(prior.space.values());
    best_ = unfitted(phi, problem_.residuals.scale().size(), start.kernels);
    Vector from = phi;
    if (kind.least_squares_start && prior.space.has_tunable()) {
      const Vector other = least_squares(problem_.residuals, prior, phi, kind.least_squares).phi;
      const double given = score(phi);
      if (score(other) > given) from = other;
    }
    const auto objective = [this](const Vector& at) { return score(at); };
    const Identified identified = identify(prior.space, from, objective, kind.subplex);
    best_.evaluations = identified.evaluations;
    return best_;
  }

 private:
  double score(const Vector& phi) {
    if (phi == best_.phi && std::isfinite(best_.score)) return best_.score;
    Fit fit = best_;
    fit.phi = phi;
    problem_.refit(fit);
    const double score = fit.score;
    if (score > best_.score) best_ = std::move(fit);
    return score;
  }

  const FitProblem& problem_;
  Fit best_;
};

}  // namespace

Fit search_nested(const GpMi& kind, const FitProblem& problem, const WarmStart& start) {
  return NestedSearch(problem).run(kind, start);
}

}  // namespace rehearse::identification
