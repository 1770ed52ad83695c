#pragma once
// Limits of a task as a constraint on policies: which of two is chosen, and what a prior may be before there are data.

#include <memory>
#include <string>
#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"
#include "rehearse/learners/learner.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::learners::black_drops {

/// Options for tasks that have limits; without effect on others.
struct SafetyOptions {
  Index rollouts = 400;  // of each policy that is compared: 0.05 is told from 0.02. At least `selection`
  Index searches = 1;    // more, at most, near good policies for safe ones, each evaluation of several rollouts
  double caution = 1;    // risks are those of episodes that deviate so many times as far from the model's mean as it
                         // says: GPs of few data are too certain where they have none
  double doubt = 0.5;    // before there are data: how far towards anywhere in its box a parameter of the prior may be
  bool explore = true;   // random actions where no safe policy promises more than was earned, if the task has a test of
                         // success and is not solved
  void fields(FieldVisitor& v);
};

/// The excess risk of a policy: the most by which a risk's upper end (95 %, Clopper and Pearson 1934) exceeds what its
/// limit allows; 0: it is safe.
double excess(const std::vector<LimitRisk>& risks, const std::vector<Limit>& limits);

/// Warnings of a proposal that is not safe: a line for each limit that it may break too often.
std::vector<std::string> warnings(const std::vector<LimitRisk>& risks, const std::vector<Limit>& limits);

/// Draws of the prior before there are data: each continuous parameter `doubt` of the way from its value to one uniform
/// in its box, each discrete one any of its choices. Empty where nothing is tunable or there is no doubt.
std::vector<std::shared_ptr<const dynamics::DynamicsModel>> doubted(const prior::Prior& prior, double doubt,
                                                                    StreamKey key);

}  // namespace rehearse::learners::black_drops
