#include "rehearse/dynamics/alternating.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "rehearse/dynamics/held_kernels.hpp"
#include "rehearse/dynamics/least_squares.hpp"

namespace rehearse::dynamics {
namespace {

constexpr double kSettled = 0.01;  // nats: a turn, or other kernels, that gain less end the search
constexpr int kMostTurns = 40, kMostRounds = 3;
constexpr Index kFewestRows = 60, kThinning = 3;  // parts: every third row of the next larger one, while so many remain
constexpr Index kManyRows = 450;                  // from here on one estimate goes on, and from its kernels alone
constexpr Index kOtherKernels = 6;  // starts of the fits that look for other kernels; up to 30 more with few rows
constexpr double kSame = 1e-3, kSameScore = 0.1;  // fractions of the boxes and nats: the same maximum

/// Every `kThinning`th row.
Dataset thin(const Dataset& data) {
  const auto rows = Eigen::seq(0, data.size() - 1, kThinning);
  return {data.states(rows, Eigen::all), data.actions(rows, Eigen::all), data.changes(rows, Eigen::all)};
}

/// A part of the rows and their residuals.
struct Part {
  Part(Dataset rows, const Residuals& all) : data(std::move(rows)), residuals(all.of(data)) {}
  const Dataset data;
  const Residuals residuals;
};

/// The largest first.
std::vector<std::unique_ptr<Part>> parts_of(const Residuals& residuals) {
  std::vector<std::unique_ptr<Part>> parts;
  const Dataset* last = &residuals.data();
  while (last->size() >= kThinning * kFewestRows) {
    parts.push_back(std::make_unique<Part>(thin(*last), residuals));
    last = &parts.back()->data;
  }
  return parts;
}

bool better(const Estimate& a, const Estimate& b) { return a.score > b.score; }

/// φ and kernels by turns, from an estimate that is fitted; ends with one.
void alternate(const Estimation& estimation, Estimate& estimate) {
  for (int i = 0; i < kMostTurns; ++i) {
    if (!std::isfinite(estimate.score)) return;
    Estimate next = estimate;
    climb(estimation, next);
    estimate.evaluations = next.evaluations;
    if (!(next.score > estimate.score + kSettled)) return;
    estimation.refit(next);
    if (!(next.score > estimate.score)) return;
    const bool settled = next.score < estimate.score + kSettled;
    estimate = std::move(next);
    if (settled) return;
  }
}

/// The same, and from other kernels at the φ found, for as long as these lead higher and `rounds` times at most.
void settle(const Estimation& estimation, Estimate& estimate, Index starts, int rounds) {
  gp::FitOptions options = estimation.fit;
  options.starts = starts;
  for (int i = 0; i < rounds && std::isfinite(estimate.score); ++i) {
    Estimate other = estimate;
    estimation.refit(other, options);
    if (!(other.score > estimate.score + kSettled)) return;
    alternate(estimation, other);
    estimate = std::move(other);
  }
}

/// The search for one combination of the discrete parameters, which the prior's space has fixed.
class Search {
 public:
  /// One estimation for each part, the smallest first, all rows last.
  Search(const GpMi& kind, std::vector<Estimation> levels) : kind_(kind), levels_(std::move(levels)) {}

  Estimate run(const Vector& phi, const std::vector<gp::Hyperparameters>& kernels) {
    const Estimate given = unfitted(phi, levels_.back().residuals.scale().size(), kernels);
    Estimate result = given;
    if (space().of_kind(Parameter::Kind::continuous).empty())
      levels_.back().refit(result);
    else
      result = no_worse_than(given, search(given));
    result.evaluations += evaluations_ + 1;
    return result;
  }

 private:
  const ParameterSpace& space() const { return levels_.back().prior->space; }

  Estimate search(const Estimate& given) {
    const Estimation& part = levels_.front();
    std::vector<Estimate> estimates = starts(part, given);
    for_each(estimates, [&](Estimate& estimate) {
      part.refit(estimate);
      alternate(part, estimate);
    });
    estimates = best_of(std::move(estimates));
    for_each(estimates,
             [&](Estimate& estimate) { settle(part, estimate, kOtherKernels + more_kernels(), kMostRounds); });
    estimates = best_of(std::move(estimates));
    for (std::size_t i = 1; i < levels_.size(); ++i) estimates = refined(std::move(estimates), levels_[i]);
    return estimates.front();
  }

  /// The given φ on all rows with its kernels as they are, and from there if that is better.
  Estimate no_worse_than(Estimate given, Estimate found) const {
    const Estimation& all = levels_.back();
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

  std::vector<Estimate> starts(const Estimation& estimation, const Estimate& given) const {
    std::vector<Estimate> all{given};
    if (!kind_.least_squares_start) return all;
    all.push_back(given);
    all.back().phi = least_squares(estimation.residuals, *estimation.prior, given.phi, kind_.least_squares).phi;
    return all;
  }

  /// The estimates of a third of the rows on all of these.
  std::vector<Estimate> refined(std::vector<Estimate> estimates, const Estimation& estimation) {
    const bool many = estimation.residuals.size() > kManyRows;
    for (Estimate& estimate : estimates)
      for (gp::FitStart& kernel : estimate.kernels) kernel.inverse_hessian /= static_cast<double>(kThinning);
    if (many) {
      for_each(estimates, [&](Estimate& estimate) { estimate.score = held_score(estimation, estimate); });
      estimates = best_of(std::move(estimates));
      estimates.resize(1);
    }
    for_each(estimates, [&](Estimate& estimate) {
      estimation.refit(estimate);
      alternate(estimation, estimate);
    });
    estimates = best_of(std::move(estimates));
    if (!many) settle(estimation, estimates.front(), kOtherKernels, 1);
    return estimates;
  }

  void for_each(std::vector<Estimate>& estimates, const std::function<void(Estimate&)>& task) const {
    levels_.back().evaluator.for_each(static_cast<Index>(estimates.size()),
                                      [&](Index i) { task(estimates[static_cast<std::size_t>(i)]); });
  }

  bool same(const Estimate& a, const Estimate& b) const {
    if (!(std::abs(a.score - b.score) < kSameScore)) return false;
    for (const Index i : space().of_kind(Parameter::Kind::continuous)) {
      const Interval box = space()[i].box;
      if (std::abs(a.phi(i) - b.phi(i)) > kSame * (box.high - box.low)) return false;
    }
    return true;
  }

  /// The highest first, each maximum once.
  std::vector<Estimate> best_of(std::vector<Estimate> estimates) {
    for (Estimate& estimate : estimates) evaluations_ += std::exchange(estimate.evaluations, 0);
    std::stable_sort(estimates.begin(), estimates.end(), better);
    std::vector<Estimate> best;
    for (Estimate& estimate : estimates) {
      const auto known = [&](const Estimate& other) { return same(estimate, other); };
      if (std::none_of(best.begin(), best.end(), known)) best.push_back(std::move(estimate));
    }
    return best;
  }

  const GpMi& kind_;
  const std::vector<Estimation> levels_;
  Index evaluations_ = 0;
};

/// The same prior with its discrete parameters fixed at `choice`.
prior::Prior fixed(const prior::Prior& prior, const std::vector<Index>& discrete, const Vector& choice) {
  std::vector<Parameter> parameters = prior.space.all();
  for (std::size_t i = 0; i < discrete.size(); ++i) {
    Parameter& parameter = parameters[static_cast<std::size_t>(discrete[i])];
    parameter = Parameter::fixed(parameter.name, choice(static_cast<Index>(i)), parameter.unit);
  }
  return {prior.name, prior.simulator, ParameterSpace(std::move(parameters))};
}

}  // namespace

Estimate search_by_turns(const GpMi& kind, const Estimation& estimation, const WarmStart& start) {
  const auto parts = parts_of(estimation.residuals);
  const ParameterSpace& space = estimation.prior->space;
  const std::vector<Index> discrete = space.of_kind(Parameter::Kind::discrete);
  Estimate best;
  Index evaluations = 0;
  for (const Vector& choice : choices_of(space, discrete)) {
    const prior::Prior prior = fixed(*estimation.prior, discrete, choice);
    const auto on = [&](const Residuals& residuals) {
      return Estimation{residuals, &prior, estimation.score, estimation.fit, estimation.evaluator};
    };
    std::vector<Estimation> levels;
    for (auto part = parts.rbegin(); part != parts.rend(); ++part) levels.push_back(on((*part)->residuals));
    levels.push_back(on(estimation.residuals));
    Vector phi = start.phi.value_or(space.values());
    phi(discrete) = choice;
    Estimate found = Search(kind, std::move(levels)).run(phi, start.kernels);
    evaluations += found.evaluations;
    if (best.phi.size() == 0 || better(found, best)) best = std::move(found);
  }
  best.evaluations = evaluations;
  return best;
}

}  // namespace rehearse::dynamics
