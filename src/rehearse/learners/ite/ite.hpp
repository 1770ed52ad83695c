#pragma once
// Intelligent trial and error (Cully 2015): an archive of many different policies, each the best of its kind on the
// prior, and Bayesian optimisation on the robot that looks for one that works there too.

#include <memory>
#include <vector>

#include "rehearse/learners/ite/adaptation.hpp"
#include "rehearse/learners/ite/illumination.hpp"
#include "rehearse/learners/learner.hpp"

namespace rehearse::learners::ite {

struct Options {
  IlluminationOptions archive;
  AdaptationOptions adaptation;
  void fields(FieldVisitor& v);
};

/// Throws InvalidInput if an option is out of bounds, there is no prior, or the task has no descriptor.
std::unique_ptr<Learner> make(Setting setting, Options options);

/// ite.
std::vector<std::unique_ptr<LearnerBuilder>> builders();

}  // namespace rehearse::learners::ite
