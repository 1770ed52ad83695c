#pragma once
// The front door: from a data set (and a prior) to a dynamics model.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rehearse/core/actuators.hpp"
#include "rehearse/core/episode.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/feature_map.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"
#include "rehearse/identification/fit_problem.hpp"
#include "rehearse/identification/kinds.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::identification {

/// The rows that GPs learned from instead of the data set.
struct SmoothedRows {
  Dataset data;
  std::vector<gp::Hyperparameters> kernels;  // one an output
};

struct Learned {
  std::shared_ptr<const dynamics::DynamicsModel> model;
  WarmStart state;                        // kernels and φ found
  std::optional<double> log_evidence;     // of all outputs together, nats; none without GPs
  std::optional<double> score;            // GP-MI's, nats
  std::optional<PhiPosterior> posterior;  // of GP-MI and MI
  std::optional<SmoothedRows> smoothed;   // where states were smoothed
  Index left_out_rows = 0;                // rows whose prior mean was not finite
  Index evaluations = 0;                  // of φ
  std::vector<std::string> notes;         // numerical failures survived, and what is said of a mirror image
};

/// The data, and the prior if there is one, that a model is learned from. Both must outlive the call.
struct LearningProblem {
  const Dataset& data;
  FeatureMap features;
  Kinematics kinematics;
  const prior::Prior* prior;                  // null: none
  Actuators actuators = {};                   // in front of the robot; the data set has their memory
  std::vector<std::string> state_names = {};  // the robot's, for notes
};

/// Thrown where the prior's mean is finite in no row of the data set.
class NoUsableRow : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

/// Throws InvalidInput if the kind needs a prior and none is given, the data set has no row, or a kernel cannot be
/// fitted; NoUsableRow.
Learned learn(const LearningProblem& problem, const Kind& kind, const WarmStart& start, const Evaluator& evaluator);

}  // namespace rehearse::identification
