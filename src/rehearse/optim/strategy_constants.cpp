#include "rehearse/optim/strategy_constants.hpp"

#include <algorithm>
#include <cmath>

namespace rehearse::optim {
namespace {

double effective_mass(const ConstVectorView& w) {
  return w.size() == 0 || w.squaredNorm() == 0 ? 0 : w.sum() * w.sum() / w.squaredNorm();
}

}  // namespace

Index default_population(Index n) { return 4 + static_cast<Index>(std::floor(3 * std::log(static_cast<double>(n)))); }

StrategyConstants::StrategyConstants(Index dimension, Index population, bool active)
    : weights(population), parents(population / 2) {
  const double n = static_cast<double>(dimension);
  for (Index i = 0; i < population; ++i)
    weights(i) = std::log((static_cast<double>(population) + 1) / 2) - std::log(static_cast<double>(i + 1));
  const Index others = population - parents;
  mu_eff = effective_mass(weights.head(parents));
  const double mu_eff_minus = effective_mass(weights.tail(others));

  c_sigma = (mu_eff + 2) / (n + mu_eff + 5);
  d_sigma = 1 + 2 * std::max(0.0, std::sqrt((mu_eff - 1) / (n + 1)) - 1) + c_sigma;
  c_c = (4 + mu_eff / n) / (n + 4 + 2 * mu_eff / n);
  c_1 = 2 / ((n + 1.3) * (n + 1.3) + mu_eff);
  c_mu = std::min(1 - c_1, 2 * (0.25 + mu_eff + 1 / mu_eff - 2) / ((n + 2) * (n + 2) + mu_eff));
  expected_norm = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));

  weights.head(parents) /= weights.head(parents).sum();
  const double negative = -weights.tail(others).cwiseMin(0).sum();
  const double mass = std::min({1 + c_1 / c_mu, 1 + 2 * mu_eff_minus / (mu_eff + 2), (1 - c_1 - c_mu) / (n * c_mu)});
  weights.tail(others) *= active && negative > 0 ? std::max(0.0, mass) / negative : 0.0;
}

}  // namespace rehearse::optim
