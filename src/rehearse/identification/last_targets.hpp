#pragma once

#include "rehearse/dynamics/residuals.hpp"

namespace rehearse::identification {

/// The targets of all rows (n × dx) at a φ. Those of the last φ are kept: a search asks for them first, and then once
/// more with their derivatives, and a prior that is a program takes long. One thread. References must outlive it.
class LastTargets {
 public:
  LastTargets(const dynamics::Residuals& residuals, const prior::Prior& prior) : residuals_(residuals), prior_(prior) {}

  Matrix at(const Vector& phi) {
    if (evaluations_ > 0 && phi == phi_) return targets_;
    targets_ = residuals_.targets(&prior_, phi);
    phi_ = phi;
    ++evaluations_;
    return targets_;
  }

  const dynamics::Residuals& residuals() const { return residuals_; }
  const prior::Prior& prior() const { return prior_; }
  Index evaluations() const { return evaluations_; }  // of the prior at all rows

 private:
  const dynamics::Residuals& residuals_;
  const prior::Prior& prior_;
  Vector phi_;
  Matrix targets_;
  Index evaluations_ = 0;
};

}  // namespace rehearse::identification
