#include "rehearse/moments/squash_moments.hpp"

namespace rehearse::moments {

SquashMoments::SquashMoments(const std::vector<Interval>& bounds) : centre_(static_cast<Index>(bounds.size())) {
  for (Index k = 0; k < centre_.size(); ++k) {
    const auto [low, high] = bounds[static_cast<std::size_t>(k)];
    const double half_width = (high - low) / 2;
    centre_(k) = (low + high) / 2;
    sines_.push_back({.output = k, .input = k, .amplitude = half_width * 9 / 8});
    sines_.push_back({.output = k, .input = k, .amplitude = half_width / 8, .frequency = 3});
  }
}

Transformed SquashMoments::operator()(const Gaussian& a) const {
  Transformed result = sine_moments(sines_, centre_.size(), a);
  result.mean += centre_;
  return result;
}

}  // namespace rehearse::moments
