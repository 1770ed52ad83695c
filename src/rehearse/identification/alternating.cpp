#include "rehearse/identification/alternating.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "rehearse/identification/held_kernels.hpp"
#include "rehearse/identification/least_squares.hpp"

namespace rehearse::identification {
namespace {

constexpr double kSettled = 0.01;  // nats: a turn, or other kernels, that gain less end the search
constexpr int kMostTurns = 40, kMostRounds = 3;
constexpr Index kFewestRows = 60, kThinning = 3;  // parts: every third row of the next larger one, while so many remain
constexpr Index kManyRows = 450;                  // from here on one fit goes on, and from its kernels alone
constexpr Index kOtherKernels = 6;  // starts of the fits that look for other kernels; up to 30 more with few rows
constexpr double kSame = 1e-3, kSameScore = 0.1;  // fractions of the boxes and nats: the same maximum

/// Every `kThinning`th row.
Dataset thin(const Dataset& data) {
  const auto rows = Eigen::seq(0, data.size() - 1, kThinning);
  return {data.states(rows, Eigen::all), data.actions(rows, Eigen::all), data.changes(rows, Eigen::all)};
}

/// A part of the rows and their residuals.
struct Part {
  Part(Dataset rows, const dynamics::Residuals& all) : data(std::move(rows)), residuals(all.of(data)) {}
  const Dataset data;
  const dynamics::Residuals residuals;
};

/// The largest first.
std::vector<std::unique_ptr<Part>> parts_of(const dynamics::Residuals& residuals) {
  std::vector<std::unique_ptr<Part>> parts;
  const Dataset* last = &residuals.data();
  while (last->size() >= kThinning * kFewestRows) {
    parts.push_back(std::make_unique<Part>(thin(*last), residuals));
    last = &parts.back()->data;
  }
  return parts;
}

bool better(const Fit& a, const Fit& b) { return a.score > b.score; }

/// φ and kernels by turns, from a fit that is fitted; ends with one.
void alternate(const FitProblem& problem, Fit& fit) {
  for (int i = 0; i < kMostTurns; ++i) {
    if (!std::isfinite(fit.score)) return;
    Fit next = fit;
    climb(problem, next);
    fit.evaluations = next.evaluations;
    if (!(next.score > fit.score + kSettled)) return;
    problem.refit(next);
    if (!(next.score > fit.score)) return;
    const bool settled = next.score < fit.score + kSettled;
    fit = std::move(next);
    if (settled) return;
  }
}

/// The same, and from other kernels at the φ found, for as long as these lead higher and `rounds` times at most.
void settle(const FitProblem& problem, Fit& fit, Index starts, int rounds) {
  gp::FitOptions options = problem.options;
  options.starts = starts;
  for (int i = 0; i < rounds && std::isfinite(fit.score); ++i) {
    Fit other = fit;
    problem.refit(other, options);
    if (!(other.score > fit.score + kSettled)) return;
    alternate(problem, other);
    fit = std::move(other);
  }
}

/// The search for one combination of the discrete parameters, which the prior's space has fixed.
class Search {
 public:
  /// One problem for each part, the smallest first, all rows last.
  Search(const GpMi& kind, std::vector<FitProblem> levels) : kind_(kind), levels_(std::move(levels)) {}

  Fit run(const Vector& phi, const std::vector<gp::Hyperparameters>& kernels) {
    const Fit given = unfitted(phi, levels_.back().residuals.scale().size(), kernels);
    Fit result = given;
    if (space().of_kind(Parameter::Kind::continuous).empty())
      levels_.back().refit(result);
    else
      result = no_worse_than(given, search(given));
    result.evaluations += evaluations_ + 1;
    return result;
  }

 private:
  const ParameterSpace& space() const { return levels_.back().prior->space; }

  Fit search(const Fit& given) {
    const FitProblem& part = levels_.front();
    std::vector<Fit> fits = starts(part, given);
    for_each(fits, [&](Fit& fit) {
      part.refit(fit);
      alternate(part, fit);
    });
    fits = best_of(std::move(fits));
    for_each(fits, [&](Fit& fit) { settle(part, fit, kOtherKernels + more_kernels(), kMostRounds); });
    fits = best_of(std::move(fits));
    for (std::size_t i = 1; i < levels_.size(); ++i) fits = refined(std::move(fits), levels_[i]);
    return fits.front();
  }

  /// The given φ on all rows with its kernels as they are, and from there if that is better.
  Fit no_worse_than(Fit given, Fit found) const {
    const FitProblem& all = levels_.back();
    given.score = held_score(all, given);
    if (!better(given, found)) return found;
    all.refit(given);
    alternate(all, given);
    return given;
  }

  /// Few rows leave the kernels more optima, and cost little.
  Index more_kernels() const {
    const double ratio = 100 / static_cast<double>(levels_.front().residuals.size());
    return levels_.size() > 1 ? 0 : std::min<Index>(static_cast<Index>(10 * ratio * ratio), 30);
  }

  std::vector<Fit> starts(const FitProblem& problem, const Fit& given) const {
    std::vector<Fit> all{given};
    if (!kind_.least_squares_start) return all;
    all.push_back(given);
    all.back().phi = least_squares(problem.residuals, *problem.prior, given.phi, kind_.least_squares).phi;
    return all;
  }

  /// The fits of a third of the rows on all of these.
  std::vector<Fit> refined(std::vector<Fit> fits, const FitProblem& problem) {
    const bool many = problem.residuals.size() > kManyRows;
    for (Fit& fit : fits)
      for (gp::FitStart& kernel : fit.kernels) kernel.inverse_hessian /= static_cast<double>(kThinning);
    if (many) {
      for_each(fits, [&](Fit& fit) { fit.score = held_score(problem, fit); });
      fits = best_of(std::move(fits));
      fits.resize(1);
    }
    for_each(fits, [&](Fit& fit) {
      problem.refit(fit);
      alternate(problem, fit);
    });
    fits = best_of(std::move(fits));
    if (!many) settle(problem, fits.front(), kOtherKernels, 1);
    return fits;
  }

  void for_each(std::vector<Fit>& fits, const std::function<void(Fit&)>& task) const {
    levels_.back().evaluator.for_each(static_cast<Index>(fits.size()),
                                      [&](Index i) { task(fits[static_cast<std::size_t>(i)]); });
  }

  bool same(const Fit& a, const Fit& b) const {
    if (!(std::abs(a.score - b.score) < kSameScore)) return false;
    for (const Index i : space().of_kind(Parameter::Kind::continuous)) {
      const Interval box = space()[i].box;
      if (std::abs(a.phi(i) - b.phi(i)) > kSame * (box.high - box.low)) return false;
    }
    return true;
  }

  /// The highest first, each maximum once.
  std::vector<Fit> best_of(std::vector<Fit> fits) {
    for (Fit& fit : fits) evaluations_ += std::exchange(fit.evaluations, 0);
    std::stable_sort(fits.begin(), fits.end(), better);
    std::vector<Fit> best;
    for (Fit& fit : fits) {
      const auto known = [&](const Fit& other) { return same(fit, other); };
      if (std::none_of(best.begin(), best.end(), known)) best.push_back(std::move(fit));
    }
    return best;
  }

  const GpMi& kind_;
  const std::vector<FitProblem> levels_;
  Index evaluations_ = 0;
};

/// The same prior with its discrete parameters fixed at `choice`.
prior::Prior fixed(const prior::Prior& prior, const std::vector<Index>& discrete, const Vector& choice) {
  std::vector<Parameter> parameters = prior.space.all();
  for (std::size_t i = 0; i < discrete.size(); ++i) {
    Parameter& parameter = parameters[static_cast<std::size_t>(discrete[i])];
    parameter = Parameter::fixed(parameter.name, choice(static_cast<Index>(i)), parameter.unit);
  }
  prior::Prior other = prior;
  other.space = ParameterSpace(std::move(parameters));
  return other;
}

}  // namespace

Fit search_by_turns(const GpMi& kind, const FitProblem& problem, const WarmStart& start) {
  const auto parts = parts_of(problem.residuals);
  const ParameterSpace& space = problem.prior->space;
  const std::vector<Index> discrete = space.of_kind(Parameter::Kind::discrete);
  Fit best;
  Index evaluations = 0;
  for (const Vector& choice : choices_of(space, discrete)) {
    const prior::Prior prior = fixed(*problem.prior, discrete, choice);
    const auto on = [&](const dynamics::Residuals& residuals) {
      return FitProblem{residuals, &prior, problem.score, problem.options, problem.evaluator};
    };
    std::vector<FitProblem> levels;
    for (auto part = parts.rbegin(); part != parts.rend(); ++part) levels.push_back(on((*part)->residuals));
    levels.push_back(on(problem.residuals));
    Vector phi = start.phi.value_or(space.values());
    phi(discrete) = choice;
    Fit found = Search(kind, std::move(levels)).run(phi, start.kernels);
    evaluations += found.evaluations;
    if (best.phi.size() == 0 || better(found, best)) best = std::move(found);
  }
  best.evaluations = evaluations;
  return best;
}

}  // namespace rehearse::identification
