#include "rehearse/optim/race.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/optim/box.hpp"

namespace rehearse::optim {
namespace {

struct Runner {
  Cmaes descent;
  Contender contender;
};

class Race {
 public:
  Race(const BatchObjective& objective, const SearchSpace& space, const RaceOptions& options, const StreamKey& key,
       const Evaluator& evaluator, const SearchListener& listener)
      : objective_(objective), options_(options), evaluator_(evaluator), listener_(listener) {
    for (Index i = 0; i < options.descents; ++i) {
      StreamKey own = key;
      own.descent = static_cast<std::uint64_t>(i);
      const bool given = i < static_cast<Index>(space.starts.size());
      const double part = i % 2 == 1 ? options.near_centre : 1;
      runners_.push_back({Cmaes(given ? space.starts[static_cast<std::size_t>(i)] : uniform_point(space.box, part, own),
                                given ? options.start_sigma : part * options.sigma, space.box, options.cmaes, own),
                          {}});
    }
  }

  RaceResult run() {
    for (Index round = 0; round < options_.rounds; ++round) {
      const Index end = options_.max_evaluations * (round + 1) / options_.rounds;
      run_round(end);
      const bool last = round + 1 == options_.rounds;
      if (!last && !can_judge(end)) continue;  // its share goes to the next
      judge(round);
      retire(round);
    }
    for (const Runner& runner : runners_) ended_.push_back(runner.contender);
    std::stable_sort(ended_.begin(), ended_.end(), better<Contender>);
    return {std::move(ended_), evaluations_};
  }

 private:
  /// True if judging fits into the round, and leaves enough to judge once in the last.
  bool can_judge(Index end) const {
    const Index after = evaluations_ + judging_cost();
    return after <= end && after + 2 * static_cast<Index>(runners_.size()) <= options_.max_evaluations;
  }

  template <class T>
  static bool better(const T& a, const T& b) {
    return a.value > b.value;
  }

  /// One generation of every descent at a time, until the judging at the round's end would exceed `end` evaluations.
  void run_round(Index end) {
    while (true) {
      std::vector<Cmaes*> live;
      for (Runner& runner : runners_)
        if (runner.descent.stop() == Stop::none) live.push_back(&runner.descent);
      const Index population = runners_.front().descent.population();
      const Index batch = population * static_cast<Index>(live.size());
      if (batch == 0 || evaluations_ + batch + judging_cost() > end) return;
      generation(live, population, batch);
    }
  }

  void generation(const std::vector<Cmaes*>& live, Index population, Index batch) {
    candidates_.resize(live.front()->dimension(), batch);
    const auto count = static_cast<Index>(live.size());
    evaluator_.for_each(count, [&](Index i) {
      candidates_.middleCols(i * population, population) = live[static_cast<std::size_t>(i)]->ask();
    });
    evaluate(1);
    evaluator_.for_each(
        count, [&](Index i) { live[static_cast<std::size_t>(i)]->tell(values_.segment(i * population, population)); });
    if (!listener_) return;
    for (const Cmaes* descent : live) best_ = std::max(best_, descent->best_value());
    listener_(evaluations_, best_);
  }

  void evaluate(Index samples) {
    values_.resize(candidates_.cols());
    objective_(candidates_, next_candidate_, samples, values_);
    next_candidate_ += static_cast<std::uint64_t>(candidates_.cols());
    evaluations_ += candidates_.cols() * samples;
  }

  Index judging_cost() const { return 2 * options_.judgements * static_cast<Index>(runners_.size()); }

  /// The best value of a noisy objective is a lucky one: best point and mean are evaluated again, many times.
  void judge(Index round) {
    const auto n = static_cast<Index>(runners_.size());
    candidates_.resize(runners_.front().descent.dimension(), 2 * n);
    for (Index i = 0; i < n; ++i) {
      candidates_.col(2 * i) = runners_[static_cast<std::size_t>(i)].descent.best_x();
      candidates_.col(2 * i + 1) = runners_[static_cast<std::size_t>(i)].descent.mean();
    }
    evaluate(std::clamp((options_.max_evaluations - evaluations_) / (2 * n), Index{1}, options_.judgements));
    values_ = values_.array().isNaN().select(-kInf, values_);
    for (Index i = 0; i < n; ++i) {
      const Index j = values_(2 * i + 1) > values_(2 * i) ? 2 * i + 1 : 2 * i;
      Runner& runner = runners_[static_cast<std::size_t>(i)];
      runner.contender = {candidates_.col(j), values_(j), round, to_string(runner.descent.stop())};
    }
  }

  void retire(Index round) {
    std::stable_sort(runners_.begin(), runners_.end(),
                     [](const Runner& a, const Runner& b) { return better(a.contender, b.contender); });
    if (round + 1 == options_.rounds) return;
    const double kept = std::ceil(static_cast<double>(runners_.size()) * options_.survivors);
    while (static_cast<double>(runners_.size()) > std::max(1.0, kept)) {
      ended_.push_back(std::move(runners_.back().contender));
      ended_.back().stop = "others were better after round " + std::to_string(round + 1);
      runners_.pop_back();
    }
  }

  const BatchObjective& objective_;
  const RaceOptions& options_;
  const Evaluator& evaluator_;
  const SearchListener& listener_;
  std::vector<Runner> runners_;
  std::vector<Contender> ended_;
  Matrix candidates_;
  Vector values_;
  std::uint64_t next_candidate_ = 0;
  Index evaluations_ = 0;
  double best_ = -kInf;
};

}  // namespace

void RaceOptions::fields(FieldVisitor& v) {
  v.integer("max_evaluations", max_evaluations, "evaluations of a search at most", between(1, 1e15));
  v.integer("descents", descents, "CMA-ES runs that start and compete", between(1, 1e6));
  v.integer("rounds", rounds, expert("rounds, of about equal numbers of evaluations"), between(1, 1000));
  v.number("survivors", survivors, expert("fraction of the runs kept after each round"), between(0, 1));
  v.number("sigma", sigma, expert("initial step size of runs from random points"), above(0));
  v.number("start_sigma", start_sigma, expert("initial step size of runs from given points"), above(0));
  v.number("near_centre", near_centre,
           expert("every second run from a random point starts in this fraction of the box, with that of sigma"),
           between(1e-6, 1));
  v.integer("judgements", judgements, expert("evaluations of a run's best point and mean when a round ends"),
            between(1, 1e6));
  v.group("cmaes", cmaes, kExpert);
  v.require(max_evaluations / 2 >= descents,
            fmt::format("max_evaluations = {}, must be ≥ 2 × descents = {}", max_evaluations, 2 * descents));
}

RaceResult race(const BatchObjective& objective, const SearchSpace& space, const RaceOptions& options,
                const StreamKey& key, const Evaluator& evaluator, const SearchListener& listener) {
  Violations violations;
  violations.add(field_violations("race", options));
  violations.require(!space.box.empty(), "race needs a box");
  violations.throw_if_any();
  return Race(objective, space, options, key, evaluator, listener).run();
}

}  // namespace rehearse::optim
