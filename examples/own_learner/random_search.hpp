#pragma once
// Your own learner: random search. Before each trial it draws policies, simulates each on the prior, and proposes the
// best, or the best one tried if that has earned more.
//
// These are the names that a learner in the catalogue has: with this file, random_search.cpp and test/ in
// src/rehearse/learners/random_search, and a CMakeLists.txt there that says which rooms they use,
//
//   rehearse_room(learners/random_search USES core dynamics rollout learners TEST_USES policy testing)
//
// the program knows it: `rehearse learn pendulum --learner random-search`. CONTRIBUTING.md, "A new learner".

#include <memory>
#include <vector>

#include "rehearse/learners/learner.hpp"

namespace rehearse::learners::random_search {

struct Options {
  Index policies = 1000;  // drawn before each trial
  double box = 5;         // θ in [−box, box] unless the policy has a box of its own
  void fields(FieldVisitor& v) {
    v.integer("search.policies", policies, "random policies that are simulated before a trial", between(1, 1e6));
    v.number("search.box", box, "θ is drawn from [-box, box]", between(1e-6, 1e6));
  }
};

/// Throws InvalidInput if an option is out of bounds or there is no prior.
std::unique_ptr<Learner> make(Setting setting, Options options);

/// random-search.
std::vector<std::unique_ptr<LearnerBuilder>> builders();

}  // namespace rehearse::learners::random_search
