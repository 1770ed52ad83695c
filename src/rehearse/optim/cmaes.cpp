#include "rehearse/optim/cmaes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/optim/median.hpp"
#include "rehearse/optim/usable.hpp"

namespace rehearse::optim {
namespace {

Index checked_population(const Vector& mean, double sigma, const std::vector<Interval>& box,
                         const CmaesOptions& options) {
  Violations violations;
  violations.add(field_violations("cmaes", options));
  if (!(sigma > 0 && std::isfinite(sigma))) violations.add(fmt::format("sigma = {}, must be > 0", to_text(sigma)));
  violations.add(box_violations(box, mean.size()));
  violations.add(start_violations(mean, box));
  violations.throw_if_any();
  return options.population > 0 ? options.population : default_population(mean.size());
}

Index default_generations(Index n, Index population) {  // Hansen 2009 (BIPOP)
  const double m = static_cast<double>(n) + 3;
  return static_cast<Index>(100 + 50 * m * m / std::sqrt(static_cast<double>(population)));
}

/// Is the median of the last 30 % of the `count` latest values no better than that of the first 30 %?
bool not_improving(const std::vector<double>& history, std::size_t count) {
  const auto part = static_cast<std::ptrdiff_t>(3 * count / 10);
  const auto first = history.end() - static_cast<std::ptrdiff_t>(count);
  return upper_median({history.end() - part, history.end()}) <= upper_median({first, first + part});
}

}  // namespace

void CmaesOptions::fields(FieldVisitor& v) {
  v.integer("population", population, "candidates of a generation; 0: 4 + ⌊3 ln n⌋ of n parameters", between(0, 1e6));
  v.boolean("active", active, "active CMA: negative weights for the worse half");
  v.boolean("elitism", elitism, "the best point so far is evaluated again in every generation");
  v.number("value_tolerance", value_tolerance, "stop when recent best values differ by less", at_least(0));
  v.number("step_tolerance", step_tolerance, "stop when all steps are below this fraction of the first", at_least(0));
  v.number("max_condition", max_condition, "stop if the covariance's condition number exceeds this", above(1));
  v.number("max_growth", max_growth, "stop if the largest axis has grown by more than this factor", above(1));
  v.boolean("stagnation", stagnation, "stop when neither best nor median improve any more");
  v.integer("max_generations", max_generations, "stop after so many generations; 0: 100 + 50 (n + 3)² / √population",
            at_least(0));
  v.require(population == 0 || population >= 4, fmt::format("population = {}, must be ≥ 4, or 0", population));
  v.integer("eigen_up_to", eigen_up_to, "parameters up to which the covariance has an eigendecomposition", at_least(0));
}

Cmaes::Cmaes(const Vector& mean, double sigma, const std::vector<Interval>& box, const CmaesOptions& options,
             const StreamKey& key)
    : options_(options),
      key_(key),
      box_(box),
      constants_(mean.size(), checked_population(mean, sigma, box, options), options.active),
      covariance_(mean.size(), mean.size() <= options.eigen_up_to ? Root::eigen : Root::cholesky),
      mean_(mean),
      path_sigma_(Vector::Zero(mean.size())),
      path_c_(Vector::Zero(mean.size())),
      step_(mean.size()),
      whitened_(mean.size()),
      normals_(population(), mean.size()),
      steps_(mean.size(), population()),
      ranked_(mean.size(), population() + 1),
      candidates_(mean.size(), population()),
      order_(static_cast<std::size_t>(population())),
      sigma_(sigma),
      first_sigma_(sigma),
      best_x_(mean),
      best_value_(kWorst) {
  if (options_.max_generations == 0) options_.max_generations = default_generations(mean.size(), population());
}

Vector Cmaes::mean() const {
  Matrix m = mean_;
  box_.project(m);
  return m;
}

const Matrix& Cmaes::ask() {
  if (asked_) return candidates_;
  draw();
  place_elite();
  asked_ = true;
  return candidates_;
}

void Cmaes::draw() {
  std::vector<std::uint64_t> candidates(order_.size(), key_.candidate), members(order_.size());
  std::iota(members.begin(), members.end(), std::uint64_t{0});
  fill_normals(key_, candidates.data(), members.data(), static_cast<std::uint64_t>(generation_), normals_);
  covariance_.colour(normals_, steps_);
  draws_ = (sigma_ * steps_).colwise() + mean_;
  candidates_ = draws_;
  box_.project(candidates_);
}

// Its place changes, or it would always be among the first candidates, which uncertainty handling evaluates twice: a
// point that is far better than the others says little of how noise changes ranks. Hansen 2011 (Injecting external
// solutions into CMA-ES), eq. 4 and Table 1.
void Cmaes::place_elite() {
  elite_ = options_.elitism && best_value_ > kWorst ? generation_ % population() : kNone;
  if (elite_ == kNone) return;
  const double n = static_cast<double>(dimension());
  const double longest = std::sqrt(n) + 2 * n / (n + 2);
  candidates_.col(elite_) = draws_.col(elite_) = best_x_;
  step_ = (best_x_ - mean_) / sigma_;
  const double length = covariance_.length(step_);
  steps_.col(elite_) = length > longest ? Vector(step_ * (longest / length)) : step_;
}

void Cmaes::tell(const ConstVectorView& values, const std::vector<Index>& order) {
  if (!asked_) throw InvalidInput("cmaes was told values before it was asked for candidates");
  if (values.size() != population() || (!order.empty() && order.size() != order_.size()))
    throw InvalidInput(fmt::format("values told = {}, must be {}", values.size(), population()));
  if (order.empty())
    rank(values);
  else
    order_ = order;
  keep_best(values);
  move_mean();
  adapt_step();
  adapt_covariance();
  keep_inside();
  evaluations_ += population();
  ++generation_;
  renew_decomposition();
  record(values);
  if (stop_ == Stop::none) stop_ = find_stop(values);
  asked_ = false;
}

Vector Cmaes::deviations() const {
  return sigma_ * Vector::NullaryExpr(dimension(), [&](Index i) { return std::sqrt(covariance_.variance(i)); });
}

const Vector& Cmaes::penalties(const ConstVectorView& values) {
  return box_.penalties(draws_, values, mean_, deviations(), constants_.mu_eff);
}

void Cmaes::rank(const ConstVectorView& values) {
  const Vector score = values - penalties(values);
  std::iota(order_.begin(), order_.end(), Index{0});
  std::stable_sort(order_.begin(), order_.end(), [&](Index a, Index b) { return usable(score(a)) > usable(score(b)); });
}

void Cmaes::keep_best(const ConstVectorView& values) {
  if (elite_ != kNone) {
    best_value_ += (usable(values(elite_)) - best_value_) / static_cast<double>(++best_count_);
    best_value_ = usable(best_value_);
  }
  for (Index i = 0; i < population(); ++i) {
    if (i == elite_ || !(usable(values(i)) > best_value_)) continue;
    best_value_ = usable(values(i));
    best_x_ = candidates_.col(i);
    best_count_ = 1;
  }
}

void Cmaes::move_mean() {
  step_.setZero();
  for (Index i = 0; i < constants_.parents; ++i)
    step_ += constants_.weights(i) * steps_.col(order_[static_cast<std::size_t>(i)]);
  mean_ += sigma_ * step_;
}

// Hansen 2016, eqs. 43 and 44; the change is bounded when the elite was a candidate, Hansen 2011, eq. 7.
void Cmaes::adapt_step() {
  const double c = constants_.c_sigma;
  covariance_.whiten(step_, whitened_);
  path_sigma_ = (1 - c) * path_sigma_ + std::sqrt(c * (2 - c) * constants_.mu_eff) * whitened_;
  const double length = path_sigma_.norm(), n = static_cast<double>(dimension());
  const double settled = 1 - std::pow(1 - c, 2 * static_cast<double>(generation_ + 1));
  path_stalled_ = length / std::sqrt(settled) >= (1.4 + 2 / (n + 1)) * constants_.expected_norm;
  const double change = c / constants_.d_sigma * (length / constants_.expected_norm - 1);
  sigma_ *= std::exp(elite_ != kNone ? std::min(change, 1.0) : change);
}

// Hansen 2016, eqs. 45 to 47.
void Cmaes::adapt_covariance() {
  const double c_c = constants_.c_c, c_1 = constants_.c_1, c_mu = constants_.c_mu;
  const double n = static_cast<double>(dimension());
  const Index parents = constants_.parents;
  path_c_ *= 1 - c_c;
  if (!path_stalled_) path_c_ += std::sqrt(c_c * (2 - c_c) * constants_.mu_eff) * step_;
  for (Index i = 0; i < population(); ++i) {
    const Index j = order_[static_cast<std::size_t>(i)];
    double weight = constants_.weights(i);
    if (weight < 0) {
      const double length = j == elite_ ? covariance_.length(steps_.col(j)) : normals_.row(j).norm();
      weight *= n / (length * length + 1e-300);
    }
    ranked_.col(i < parents ? i : i + 1) = std::sqrt(c_mu * std::abs(weight)) * steps_.col(j);
  }
  ranked_.col(parents) = std::sqrt(c_1) * path_c_;
  const double lost = path_stalled_ ? c_c * (2 - c_c) : 0;
  const double decay = 1 + c_1 * lost - c_1 - c_mu * constants_.weights.sum();
  covariance_.update(decay, ranked_.leftCols(parents + 1),
                     ranked_.rightCols(options_.active ? population() - parents : 0));
}

// Not in every generation: it costs more than all the rest, and C changes slowly (Hansen 2016, appendix B.2, and the
// gap of pycma, 0.5 / (n (c_1 + c_μ)) generations).
void Cmaes::renew_decomposition() {
  const double gap = 0.5 / (static_cast<double>(dimension()) * (constants_.c_1 + constants_.c_mu));
  if (static_cast<double>(generation_ - decomposed_) < gap) return;
  decomposed_ = generation_;
  if (!covariance_.decompose()) stop_ = Stop::condition;
}

// A standard deviation beyond the box is as good as a uniform draw, and would grow for ever along a coordinate that
// does not matter.
void Cmaes::keep_inside() {
  for (Index i = 0; box_.bounded() && i < dimension(); ++i) {
    const double deviation = sigma_ * std::sqrt(covariance_.variance(i));
    if (deviation > box_.width(i)) covariance_.scale(i, box_.width(i) / deviation);
  }
}

void Cmaes::record(const ConstVectorView& values) {
  best_history_.push_back(usable(values(order_.front())));
  median_history_.push_back(usable(values(order_[order_.size() / 2])));
}

Stop Cmaes::find_stop(const ConstVectorView& values) const {
  if (covariance_.condition() > options_.max_condition) return Stop::condition;
  if (!(sigma_ * std::sqrt(covariance_.largest_eigenvalue()) < options_.max_growth * first_sigma_)) return Stop::growth;
  if (values_settled(values)) return Stop::value_tolerance;
  if (steps_vanished()) return Stop::step_tolerance;
  if (without_effect()) return Stop::no_effect;
  if (options_.stagnation && stagnated()) return Stop::stagnation;
  return generation_ >= options_.max_generations ? Stop::max_generations : Stop::none;
}

bool Cmaes::values_settled(const ConstVectorView& values) const {
  const auto window = static_cast<std::ptrdiff_t>(
      10 + std::ceil(30 * static_cast<double>(dimension()) / static_cast<double>(population())));
  if (std::ssize(best_history_) < window) return false;
  const auto [low, high] = std::minmax_element(best_history_.end() - window, best_history_.end());
  const double least = std::min(*low, usable(values(order_.back())));
  if (*high == kWorst) return false;  // no finite value yet says nothing about where to go, but nothing is settled
  return *high - least <= options_.value_tolerance;
}

bool Cmaes::steps_vanished() const {
  const double tolerance = options_.step_tolerance * first_sigma_;
  for (Index i = 0; i < dimension(); ++i)
    if (sigma_ * std::max(std::sqrt(covariance_.variance(i)), std::abs(path_c_(i))) >= tolerance) return false;
  return true;
}

bool Cmaes::without_effect() const {
  const auto axis = covariance_.axis(generation_ % dimension());
  if (((mean_ + 0.1 * sigma_ * axis).array() == mean_.array()).all()) return true;
  for (Index i = 0; i < dimension(); ++i)
    if (mean_(i) == mean_(i) + 0.2 * sigma_ * std::sqrt(covariance_.variance(i))) return true;
  return false;
}

bool Cmaes::stagnated() const {
  const double shortest = 120 + 30 * static_cast<double>(dimension()) / static_cast<double>(population());
  const double count = std::clamp(0.2 * static_cast<double>(generation_), shortest, 20000.0);
  if (static_cast<double>(generation_) < count || generation_ % 10 != 0) return false;
  const auto length = static_cast<std::size_t>(count);
  return not_improving(best_history_, length) && not_improving(median_history_, length);
}

}  // namespace rehearse::optim
