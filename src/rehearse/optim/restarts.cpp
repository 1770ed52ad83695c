#include "rehearse/optim/restarts.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/optim/usable.hpp"

namespace rehearse::optim {
namespace {

/// The start of the next descent.
struct Plan {
  Index population;
  double step;
  Index max_evaluations;
  bool large;
};

/// Keeps the `count` highest, best first; of equals the earlier.
void keep(std::vector<Candidate>& list, Candidate candidate, Index count) {
  const auto place =
      std::find_if(list.begin(), list.end(), [&](const Candidate& other) { return other.value < candidate.value; });
  list.insert(place, std::move(candidate));
  if (static_cast<Index>(list.size()) > count) list.pop_back();
}

class Search {
 public:
  Search(const BatchObjective& objective, const Vector& start, const std::vector<Interval>& box,
         const SearchOptions& options, const StreamKey& key, const SearchListener& listener);
  SearchResult run();

 private:
  Rng random() const;
  StreamKey key_of(Index descent) const;
  bool next(Plan& plan);
  Plan small_descent(Rng& rng) const;
  void descend(const Plan& plan);
  void generation(Cmaes& cmaes, UncertaintyHandler& noise);
  std::string stop_of(const Cmaes& cmaes, const UncertaintyHandler& noise, Index used, const Plan& plan);
  void finish(const Cmaes& cmaes, const UncertaintyHandler& noise, Descent& descent);
  void choose();
  void evaluate(const ConstMatrixView& X, Index samples, VectorView values);
  Vector start_of(Index descent) const;
  Vector scaled(const Vector& unit) const { return low_ + width_.cwiseProduct(unit); }
  Index left() const { return options_.max_evaluations - options_.reserved() - result_.evaluations; }

  const BatchObjective& objective_;
  const SearchOptions& options_;
  const SearchListener& listener_;
  StreamKey key_;
  Vector start_, low_, width_;
  std::vector<Interval> unit_box_;
  Index smallest_;               // population
  Index doublings_ = 0;          // of the large descents so far
  Index last_large_ = 0;         // evaluations of the last large descent
  Index large_ = 0, small_ = 0;  // evaluations of both regimes
  std::uint64_t numbered_ = 0;   // candidates so far
  double best_ = kWorst;
  Matrix scaled_;
  Vector values_, again_;
  std::vector<Candidate> bests_, means_;
  SearchResult result_;
};

Search::Search(const BatchObjective& objective, const Vector& start, const std::vector<Interval>& box,
               const SearchOptions& options, const StreamKey& key, const SearchListener& listener)
    : objective_(objective),
      options_(options),
      listener_(listener),
      key_(key),
      start_(start),
      low_(start.size()),
      width_(start.size()),
      unit_box_(box.size(), Interval{0, 1}),
      smallest_(options.cmaes.population > 0 ? options.cmaes.population : default_population(start.size())) {
  for (Index i = 0; i < start.size(); ++i) {
    const Interval& b = box[static_cast<std::size_t>(i)];
    low_(i) = b.low;
    width_(i) = b.high - b.low;
  }
  result_.x = start;
  result_.value = kWorst;
}

SearchResult Search::run() {
  Plan plan{smallest_, options_.start_step > 0 ? options_.start_step : options_.step, options_.max_evaluations, false};
  do descend(plan);
  while (next(plan));
  choose();
  return std::move(result_);
}

/// Random numbers for the plan of the next descent.
Rng Search::random() const { return Rng(key_of(static_cast<Index>(result_.descents.size()))); }

StreamKey Search::key_of(Index descent) const {
  StreamKey key = key_;
  key.descent = static_cast<std::uint64_t>(descent);
  return key;
}

// Hansen 2009: the regime that used fewer evaluations goes next. The first descent counts as small.
bool Search::next(Plan& plan) {
  const Descent& last = result_.descents.back();
  if (plan.large) last_large_ = last.evaluations;
  (plan.large ? large_ : small_) += last.evaluations;
  if (!result_.stop.empty()) return false;
  if (options_.strategy == Strategy::single) result_.stop = last.stop;
  if (options_.strategy == Strategy::bipop && small_ < large_) {
    Rng rng = random();
    plan = small_descent(rng);
  } else {
    if (doublings_ == options_.max_doublings && result_.stop.empty()) result_.stop = "max_doublings reached";
    plan = {smallest_ << ++doublings_, options_.step, options_.max_evaluations, true};
  }
  if (left() < plan.population && result_.stop.empty()) result_.stop = "max_evaluations reached";
  return result_.stop.empty();
}

// Hansen 2009: λ_s = ⌊λ (½ λ_l / λ)^(U²)⌋, σ_s = σ 10^(−2U), at most half of the evaluations of the last large one.
Plan Search::small_descent(Rng& rng) const {
  const double exponent = std::pow(rng.uniform(), 2), ratio = std::ldexp(0.5, static_cast<int>(doublings_));
  const double population = std::floor(static_cast<double>(smallest_) * std::pow(ratio, exponent));
  return {static_cast<Index>(population), options_.step * std::pow(10, -2 * rng.uniform()),
          std::max(last_large_ / 2, Index{1}), false};
}

Vector Search::start_of(Index descent) const {
  Vector unit = (start_ - low_).cwiseQuotient(width_).cwiseMax(0).cwiseMin(1);
  if (descent == 0) return unit;
  StreamKey key = key_of(descent);
  key.candidate = 1;  // 0 draws the plan
  Rng rng(key);
  for (double& u : unit) u = rng.uniform();
  return unit;
}

void Search::descend(const Plan& plan) {
  const Index number = static_cast<Index>(result_.descents.size());
  CmaesOptions cmaes_options = options_.cmaes;
  cmaes_options.population = plan.population;
  Cmaes cmaes(start_of(number), plan.step, unit_box_, cmaes_options, key_of(number));
  UncertaintyHandler noise(options_.uncertainty, cmaes.dimension(), plan.population);
  values_.resize(plan.population);
  const Index before = result_.evaluations;
  Descent descent{.population = plan.population, .step = plan.step};
  while ((descent.stop = stop_of(cmaes, noise, result_.evaluations - before, plan)).empty()) generation(cmaes, noise);
  finish(cmaes, noise, descent);
  descent.evaluations = result_.evaluations - before;
  result_.descents.push_back(descent);
}

/// The reason to stop a descent; empty: it goes on. Also sets the stop of the whole search.
std::string Search::stop_of(const Cmaes& cmaes, const UncertaintyHandler& noise, Index used, const Plan& plan) {
  if (best_ >= options_.target)
    result_.stop = "target reached";
  else if (noise.generation_cost() > left())
    result_.stop = "max_evaluations reached";
  if (!result_.stop.empty()) return result_.stop;
  if (cmaes.stop() != Stop::none) return to_string(cmaes.stop());
  return used >= plan.max_evaluations ? "its share of the evaluations is used" : "";
}

void Search::generation(Cmaes& cmaes, UncertaintyHandler& noise) {
  const Matrix& X = cmaes.ask();
  const Index samples = noise.samples(), twice = noise.reevaluations();
  evaluate(X, samples, values_);
  if (twice == 0) {
    cmaes.tell(values_);
  } else {
    again_.resize(twice);
    evaluate(X.leftCols(twice), samples, again_);
    const std::vector<Index> order = noise.rank(values_, again_, cmaes.penalties(values_));
    cmaes.tell(values_, order);
    cmaes.widen(noise.sigma_factor());
  }
  best_ = std::max(best_, cmaes.best_value());
  if (listener_) listener_(result_.evaluations, best_);
}

void Search::evaluate(const ConstMatrixView& X, Index samples, VectorView values) {
  scaled_.resize(X.rows(), X.cols());
  scaled_ = (width_.asDiagonal() * X).colwise() + low_;
  objective_(scaled_, numbered_, samples, values);
  numbered_ += static_cast<std::uint64_t>(X.cols());
  result_.evaluations += samples * X.cols();
}

void Search::finish(const Cmaes& cmaes, const UncertaintyHandler& noise, Descent& descent) {
  const Index number = static_cast<Index>(result_.descents.size());
  Vector mean_value = Vector::Constant(1, kWorst);
  const Vector mean = cmaes.mean();
  if (left() >= noise.samples()) evaluate(mean, noise.samples(), mean_value);
  mean_value(0) = usable(mean_value(0));
  best_ = std::max(best_, mean_value(0));
  keep(bests_, {scaled(cmaes.best_x()), cmaes.best_value(), number, false}, options_.candidates);
  keep(means_, {scaled(mean), mean_value(0), number, true}, options_.candidates);
  descent.generations = cmaes.generation();
  descent.best_value = cmaes.best_value();
  descent.mean_value = mean_value(0);
}

void Search::choose() {
  auto& all = result_.candidates;
  if (!options_.means_alone) all = bests_;
  all.insert(all.end(), means_.begin(), means_.end());
  if (options_.final_samples > 0) {
    Matrix X(low_.size(), static_cast<Index>(all.size()));
    Vector values(X.cols());
    for (Index j = 0; j < X.cols(); ++j) X.col(j) = all[static_cast<std::size_t>(j)].x;
    objective_(X, numbered_, options_.final_samples, values);
    result_.evaluations += options_.final_samples * X.cols();
    for (Index j = 0; j < X.cols(); ++j) all[static_cast<std::size_t>(j)].value = usable(values(j));
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.value > b.value; });
  if (!(all.front().value > kWorst)) return;
  result_.x = all.front().x;
  result_.value = all.front().value;
}

}  // namespace

void SearchOptions::fields(FieldVisitor& v) {
  v.choice("strategy", strategy,
           "one run, IPOP (population doubles at each restart), or BIPOP (alternating with small populations)",
           {"single", "ipop", "bipop"});
  v.integer("max_evaluations", max_evaluations, "evaluations of all runs together at most", at_least(1));
  v.number("step", step, "initial step size of a run, as a fraction of the bounds' width", between(1e-6, 10),
           published(0.5, kAuthors));
  v.number("start_step", start_step, "initial step size of the run from the given start; 0: as the others",
           between(0, 10));
  v.integer("max_doublings", max_doublings, "doublings of the population at most", between(0, 30));
  v.number("target", target, "stop at this return", any_value());
  v.integer("candidates", candidates, "best points, and as many means, from which the result is chosen",
            between(1, 1e6));
  v.boolean("means_alone", means_alone,
            "candidates are distribution means alone, since best points of noisy objectives are lucky draws",
            published(true, "libcmaes"));
  v.integer("final_samples", final_samples, "re-evaluations of each candidate at the end; 0: the values seen decide",
            between(0, 1e6));
  v.publish("cmaes.elitism", published(true));
  v.group("cmaes", cmaes, kExpert);
  v.group("uncertainty", uncertainty, kExpert);
  v.require(
      max_evaluations > reserved(),
      fmt::format("max_evaluations = {}, must be > 2 candidates × final_samples = {}", max_evaluations, reserved()));
}

SearchResult maximise(const BatchObjective& objective, const Vector& start, const std::vector<Interval>& box,
                      const SearchOptions& options, const StreamKey& key, const SearchListener& listener) {
  require_searchable(start, box, field_violations("search", options));
  return Search(objective, start, box, options, key, listener).run();
}

}  // namespace rehearse::optim
