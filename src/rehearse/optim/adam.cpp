#include "rehearse/optim/adam.hpp"

#include <cmath>

namespace rehearse::optim {

Adam::Adam(Index coordinates, const AdamOptions& options)
    : options_(options), mean_(Vector::Zero(coordinates)), square_(Vector::Zero(coordinates)) {}

void Adam::ascend(VectorView x, const ConstVectorView& gradient, double done) {
  if (!gradient.allFinite()) return;
  const auto& [first, last, mean_decay, square_decay, floor] = options_;
  mean_ = mean_decay * mean_ + (1 - mean_decay) * gradient;
  square_ = square_decay * square_ + (1 - square_decay) * gradient.cwiseAbs2();
  mean_weight_ *= mean_decay;
  square_weight_ *= square_decay;
  const double step = first * std::pow(last / first, done) / (1 - mean_weight_);
  x.array() += step * mean_.array() / ((square_ / (1 - square_weight_)).array().sqrt() + floor);
}

}  // namespace rehearse::optim
