#include "rehearse/moments/make_prior_moments.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/moments/linearised_prior.hpp"
#include "rehearse/moments/unscented_prior.hpp"

namespace rehearse::moments {

std::shared_ptr<const PriorMoments> make_prior_moments(prior::Prior prior, Vector phi, Index states, Index actions,
                                                       Through through) {
  const Index parameters = prior.simulator->parameters().size();
  if (phi.size() != parameters)
    throw InvalidInput(fmt::format("prior: φ has {} numbers, must have {}", phi.size(), parameters));
  if (through == Through::linearised)
    return std::make_shared<LinearisedPrior>(std::move(prior), std::move(phi), states, actions);
  return std::make_shared<UnscentedPrior>(std::move(prior), std::move(phi), states, actions);
}

}  // namespace rehearse::moments
