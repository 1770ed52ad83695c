#pragma once

#include <optional>
#include <string>

#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/experiment/policy_evaluation.hpp"
#include "rehearse/experiment/spec.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::experiment {

/// A policy of a file, as if it were a trial's.
struct GivenPolicy {
  Learned learned;
  std::optional<double> total_reward;  // empty: its trial was to come
};

/// Reads a file that `export` wrote as JSON (policy::to_json). source: the file's name. Throws InvalidInput if it is no
/// such file, or is a policy of another scenario: other states, actions or kind, or one that does not do what the file
/// says.
GivenPolicy given_policy(const std::string& text, const std::string& source, const scenario::Scenario& scenario);

/// The complete spec of a run that begins with such a policy (Spec::start). Throws InvalidInput, too, if the learner
/// cannot begin with one, or begins with those of another kind (random actions, for example).
Spec with_start(const Catalogue& catalogue, Spec spec, const std::string& text, const std::string& source);

}  // namespace rehearse::experiment
