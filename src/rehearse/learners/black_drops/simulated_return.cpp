#include "rehearse/learners/black_drops/simulated_return.hpp"

#include <algorithm>

namespace rehearse::learners::black_drops {
namespace {

Measurement measured(const rollout::Simulated& simulated, Index candidate) {
  const Index episodes = simulated.returns.rows();
  Measurement result;
  Vector left = Vector::Zero(episodes);
  for (const Matrix& broken : simulated.broken) {
    result.risks.push_back({(broken.col(candidate).array() > 0).count(), episodes});
    left = left.cwiseMax(broken.col(candidate));
  }
  result.early = (left.array() > 0).select((1 + left.array()) / 2, 0.0).mean();
  return result;
}

bool allowed(const std::vector<LimitRisk>& risks, const std::vector<Limit>& limits) {
  for (std::size_t l = 0; l < risks.size(); ++l)
    if (static_cast<double>(risks[l].broken) > limits[l].risk * static_cast<double>(risks[l].episodes)) return false;
  return true;
}

}  // namespace

void SimulatedReturn::operator()(const ConstMatrixView& Theta, std::uint64_t first, Index samples, VectorView values) {
  const double deviations = options_.constrained ? options_.safety.caution : 1;
  const rollout::Simulated simulated = simulate(Theta, first, samples * options_.particles, deviations);
  values = simulated.returns.colwise().mean().transpose();
  if (!options_.constrained) return;
  seen_ = {std::min(seen_.low, values.minCoeff()), std::max(seen_.high, values.maxCoeff())};
  const double range = seen_.high > seen_.low ? seen_.high - seen_.low : 1;
  for (Index j = 0; j < values.size(); ++j) {
    const Measurement of = measured(simulated, j);
    if (!allowed(of.risks, problem_.task.limits)) values(j) = seen_.low - range * of.early;
  }
}

std::vector<Measurement> SimulatedReturn::measure(const ConstMatrixView& Theta, std::uint64_t first, Index samples) {
  rollout::Simulated simulated = simulate(Theta, first, samples * options_.particles, 1);
  const Vector means = simulated.returns.colwise().mean().transpose();
  if (doubts_its_certainty())
    simulated.broken = simulate(Theta, first, samples * options_.particles, options_.safety.caution).broken;
  std::vector<Measurement> all;
  for (Index j = 0; j < means.size(); ++j) {
    all.push_back(measured(simulated, j));
    all.back().mean = means(j);
  }
  return all;
}

bool SimulatedReturn::doubts_its_certainty() const {
  const bool uncertain = problem_.doubted.empty() && !problem_.model.certain();
  return uncertain && !problem_.task.limits.empty() && options_.safety.caution != 1;
}

rollout::ReturnGradients SimulatedReturn::gradients(const ConstMatrixView& Theta, Index particles) {
  auto found = rollout::return_gradients({problem_.model, problem_.policy, problem_.task, key_, options_.simulate},
                                         Theta, {next_, particles}, problem_.evaluator);
  rollouts_ += Theta.cols() * particles;
  next_ += static_cast<std::uint64_t>(Theta.cols());
  failed_ += found.failed;
  return found;
}

rollout::Simulated SimulatedReturn::simulate(const ConstMatrixView& Theta, std::uint64_t first, Index episodes,
                                             double deviations) {
  rollout::SimulateOptions options = options_.simulate;
  options.deviations = deviations;
  const rollout::Simulated simulated =
      problem_.doubted.empty() ? rollout::simulate({problem_.model, problem_.policy, problem_.task, key_, options},
                                                   Theta, {first, episodes}, problem_.evaluator)
                               : simulate_in_doubt(Theta, episodes);
  rollouts_ += simulated.returns.size();
  next_ = std::max(next_, first + static_cast<std::uint64_t>(Theta.cols()));
  failed_ += simulated.failed;
  return simulated;
}

/// Rollouts go round the models: the r-th of all, counted from the first call on, has model r mod their number, and a
/// stream of its own there.
rollout::Simulated SimulatedReturn::simulate_in_doubt(const ConstMatrixView& Theta, Index episodes) const {
  const auto models = static_cast<Index>(problem_.doubted.size());
  rollout::Simulated all{.returns = Matrix(episodes, Theta.cols())};
  all.broken.assign(problem_.task.limits.size(), Matrix(episodes, Theta.cols()));
  const Index total = all.returns.size();
  for (Index m = 0; m < models; ++m) {
    const Index begin = (m - rollouts_ % models + models) % models, count = (total - begin + models - 1) / models;
    if (begin >= total) continue;
    Matrix own(Theta.rows(), count);
    for (Index i = 0; i < count; ++i) own.col(i) = Theta.col((begin + i * models) / episodes);
    StreamKey key = key_;
    key.descent = static_cast<std::uint64_t>(m) + 1;
    const rollout::Simulated some = rollout::simulate(
        {*problem_.doubted[static_cast<std::size_t>(m)], problem_.policy, problem_.task, key, options_.simulate}, own,
        {static_cast<std::uint64_t>((rollouts_ + begin) / models), 1}, problem_.evaluator);
    const auto scatter = [&](const Matrix& from, Matrix& to) {
      for (Index i = 0; i < count; ++i) to.data()[begin + i * models] = from(0, i);
    };
    scatter(some.returns, all.returns);
    for (std::size_t l = 0; l < all.broken.size(); ++l) scatter(some.broken[l], all.broken[l]);
    all.failed += some.failed;
  }
  return all;
}

}  // namespace rehearse::learners::black_drops
