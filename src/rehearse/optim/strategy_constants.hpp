#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::optim {

/// The weights and learning rates of CMA-ES for dimension n and population λ, defaults of Hansen 2016 (The CMA
/// evolution strategy: a tutorial, arXiv 1604.00772), Table 1 and eqs. 49–58.
struct StrategyConstants {
  StrategyConstants(Index n, Index population, bool active);

  Vector weights;  // λ, descending; the first `parents` are positive and sum to 1; without `active` the rest is 0
  Index parents;   // μ
  double mu_eff;   // variance-effective selection mass
  double c_sigma, d_sigma;
  double c_c, c_1, c_mu;
  double expected_norm;  // E‖N(0, I)‖
};

/// 4 + ⌊3 ln n⌋, Hansen 2016, eq. 48.
Index default_population(Index n);

}  // namespace rehearse::optim
