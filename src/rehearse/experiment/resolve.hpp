#pragma once

#include <memory>
#include <optional>

#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/experiment/spec.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::experiment {

/// A spec with everything it names.
struct Resolved {
  Spec spec;  // complete: the prior named and every option listed with its value
  scenario::Scenario scenario;
  std::optional<prior::Prior> prior;
  std::shared_ptr<const learners::LearnerBuilder> learner;
  Comments comments;
  std::optional<RobotFile> robot = {};     // the file that describes the robot; empty: it is built in
  std::vector<std::string> warnings = {};  // what can be done so, and is hardly meant, a line each

  /// The prior that plays the robot in evaluations, where there is no plant. Null: there is a plant, no prior, or a
  /// choice among several.
  const prior::Prior* stand_in() const;
};

/// Throws InvalidInput with a line for everything that is wrong.
Resolved resolve(const Catalogue& catalogue, const Spec& spec);

/// The same for looking at a run that has begun, perhaps by an older version: its options may contradict each other.
/// settings: they are set after these, and what they contradict is refused.
Resolved resolve_begun(const Catalogue& catalogue, const Spec& spec, const learners::OptionTexts& settings = {});

/// The complete spec alone, even where the learner cannot do with the task or the policy that it describes so far.
Spec completed(const Catalogue& catalogue, const Spec& spec);

/// The learner of a spec that names none: gp-mi where there is a guess of the robot's dynamics, else black-drops.
std::string default_learner(const Catalogue& catalogue, const Spec& spec);

}  // namespace rehearse::experiment
