#include "rehearse/optim/stop.hpp"

namespace rehearse::optim {

std::string to_string(Stop stop) {
  switch (stop) {
    case Stop::none:
      return "not stopped";
    case Stop::value_tolerance:
      return "recent values differ by less than value_tolerance";
    case Stop::step_tolerance:
      return "steps are smaller than step_tolerance";
    case Stop::condition:
      return "covariance is worse conditioned than max_condition";
    case Stop::growth:
      return "steps have grown by more than max_growth";
    case Stop::stagnation:
      return "neither best nor median value improves";
    case Stop::no_effect:
      return "steps are too small to change the mean";
    case Stop::max_generations:
      return "max_generations reached";
  }
  return "unknown";
}

}  // namespace rehearse::optim
