#include "rehearse/learners/black_drops/gradient_search.hpp"

#include <algorithm>
#include <limits>

#include "rehearse/optim/box.hpp"
#include "rehearse/policy/differentiable.hpp"

namespace rehearse::learners::black_drops {
namespace {

constexpr double kWithoutDropout = 0.25;  // of the search, its end

struct GradientDescent {
  Vector theta;
  optim::Adam adam;
  double value = 0;  // mean return of the later half of a round's steps
};

/// Factors of θ: 0 for weights that are left out, and such that the others make up for them.
class Dropout {
 public:
  Dropout(const policy::Policy& policy, double fraction, StreamKey key) : fraction_(fraction), key_(key) {
    key_.purpose = Purpose::dropout;
    if (const auto* known = dynamic_cast<const policy::Differentiable*>(&policy)) weights_ = known->unit_weights();
  }

  /// One column a descent.
  Matrix factors(Index parameters, Index descents, Index step, double done) {
    Matrix factors = Matrix::Ones(parameters, descents);
    const double fraction = fraction_ * std::max(0.0, 1 - done / (1 - kWithoutDropout));
    if (fraction == 0) return factors;
    for (Index d = 0; d < descents; ++d) {
      key_.descent = static_cast<std::uint64_t>(d);
      key_.candidate = static_cast<std::uint64_t>(step);
      Rng rng(key_);
      for (const Index i : weights_) factors(i, d) = rng.uniform() < fraction ? 0 : 1 / (1 - fraction);
    }
    return factors;
  }

 private:
  double fraction_;
  StreamKey key_;
  std::vector<Index> weights_;
};

Vector start_of(Index descent, const policy::Policy& policy, const GradientSpace& space, double part, StreamKey key) {
  if (descent < static_cast<Index>(space.starts.size())) return space.starts[static_cast<std::size_t>(descent)];
  key.purpose = Purpose::random_policy;
  key.descent = static_cast<std::uint64_t>(descent);
  const std::vector<Interval> box(static_cast<std::size_t>(policy.parameters()), space.interval);
  return optim::uniform_point(box, part, key);
}

}  // namespace

void GradientOptions::fields(FieldVisitor& v) {
  v.integer("steps", steps, "gradient steps of a run that is kept to the end", between(1, 1e6),
            published(4000, "Amadio 2022"));
  v.integer("particles", particles, "rollouts per gradient step, divided among the remaining runs", between(1, 1e6),
            published(400, "Amadio 2022"));
  v.integer("descents", descents, "gradient runs that start", between(1, 1e4), published(1, "Amadio 2022"));
  v.integer("rounds", rounds, expert("rounds, after each of which the better half of the runs is kept"),
            between(1, 100));
  v.number("start", start, "runs from random points start in this fraction of the parameters' range, around its centre",
           between(0, 1));
  v.number("dropout", dropout, "initial dropout rate of the hidden units' output weights; falls to 0", between(0, 0.9),
           published(0.25, "Amadio 2022"));
  v.group("adam", adam, kExpert);
}

std::vector<Vector> search_by_gradient(SimulatedReturn& objective, const policy::Policy& policy,
                                       const GradientSpace& space, const GradientOptions& options, const StreamKey& key,
                                       const optim::SearchListener& listener) {
  std::vector<GradientDescent> descents;
  for (Index d = 0; d < options.descents; ++d)
    descents.push_back({start_of(d, policy, space, options.start, key), {policy.parameters(), options.adam}});
  Dropout dropout(policy, options.dropout, key);
  std::vector<Vector> given_up;  // the last one last
  Index step = 0;
  for (Index round = 1; round <= options.rounds; ++round) {
    const Index first = step, end = options.steps * round / options.rounds;
    if (first == end) continue;  // nothing is known by which descents could be given up
    const auto active = static_cast<Index>(descents.size());
    Matrix Theta(policy.parameters(), active);
    for (GradientDescent& descent : descents) descent.value = 0;
    for (; step < end; ++step) {
      const double done = static_cast<double>(step) / static_cast<double>(options.steps);
      const Matrix factors = dropout.factors(Theta.rows(), active, step, done);
      for (Index d = 0; d < active; ++d) Theta.col(d) = descents[static_cast<std::size_t>(d)].theta;
      const auto found =
          objective.gradients(Theta.cwiseProduct(factors), std::max<Index>(1, options.particles / active));
      for (Index d = 0; d < active; ++d) {
        GradientDescent& descent = descents[static_cast<std::size_t>(d)];
        descent.adam.ascend(descent.theta, found.by_theta.col(d).cwiseProduct(factors.col(d)), done);
        descent.theta = descent.theta.cwiseMax(space.interval.low).cwiseMin(space.interval.high);
        if (2 * step >= first + end - 1) descent.value += found.returns(d);
      }
      if (listener) listener(objective.rollouts(), found.returns.maxCoeff());
    }
    std::ranges::stable_sort(descents, [](const auto& a, const auto& b) { return a.value > b.value; });
    for (const Index left = round < options.rounds ? (active + 1) / 2 : active;
         static_cast<Index>(descents.size()) > left; descents.pop_back())
      given_up.push_back(descents.back().theta);
  }
  std::vector<Vector> found;
  for (GradientDescent& descent : descents) found.push_back(std::move(descent.theta));
  found.insert(found.end(), given_up.rbegin(), given_up.rend());
  return found;
}

}  // namespace rehearse::learners::black_drops
