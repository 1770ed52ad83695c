#include "rehearse/dynamics/gp_options.hpp"

namespace rehearse::dynamics {

gp::FitOptions fit_options(gp::FitOptions options, Index inputs) {
  if (inputs <= kFewInputs) return options;
  options.parsimonious = true;
  options.trend = false;
  return options;
}

}  // namespace rehearse::dynamics
