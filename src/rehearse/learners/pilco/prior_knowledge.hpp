#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "rehearse/learners/learner.hpp"
#include "rehearse/learners/pilco/options.hpp"
#include "rehearse/moments/moment_term.hpp"

namespace rehearse::learners::pilco {

/// Knowledge of the prior that the trials on the robot begin with.
struct PriorKnowledge {
  std::vector<moments::MomentTerm> network;  // the means of the GPs of the prior system; empty: none could be learned
  std::vector<Vector> policies;              // found on the prior itself, one a search
  Vector theta;                              // the best policy found
  std::optional<double> predicted_return;    // its expected return, on the GPs or on the prior itself
  Index evaluations = 0;                     // expected returns computed on the way, in all
  Index failed = 0;                          // of these, without a value
  std::vector<std::string> notes;            // numerical failures survived
};

nlohmann::json to_json(const PriorKnowledge& knowledge);
/// Throws nlohmann::json::exception or InvalidInput where something else was saved.
PriorKnowledge to_knowledge(const nlohmann::json& j);

/// Learns a PriorKnowledge: `learn_on_prior`, or `search_on_prior`.
using LearnOnPrior = std::function<PriorKnowledge(const Setting& setting, const Options& options)>;

}  // namespace rehearse::learners::pilco
