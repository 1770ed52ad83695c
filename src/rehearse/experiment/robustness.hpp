#pragma once

#include <functional>
#include <string>
#include <vector>

#include "rehearse/experiment/policy_evaluation.hpp"

namespace rehearse::experiment {

/// The outcome of a policy on a plant with one parameter changed.
struct Changed {
  std::string parameter;  // "m1" of the option plant.m1, or of prior.m1 where the prior plays the robot
  double factor = 1;      // times the run's value
  double value = 0;
  Summary summary;
  std::string failure = {};  // why this robot has no summary: it fails; empty: it does not
};

/// Factors of a parameter: ± 25 %.
inline const std::vector<double> kFactors = {0.75, 0.875, 1, 1.125, 1.25};

/// Evaluates the policy with one parameter of the plant changed at a time, each of the options plant.NAME (where the
/// prior plays the robot, of its parameters that are no choices) that is not 0, by every factor, always with the same
/// random numbers. Values beyond the bounds of their option are left out. make: the run with one more option
/// (`read_run`). Throws InvalidInput if the scenario has no such option, and what `evaluate` throws where the robot
/// fails as it is.
std::vector<Changed> robustness(const std::function<Resolved(const std::string& key, const std::string& value)>& make,
                                const Resolved& run, const Learned& learned, const EvaluationPlan& plan,
                                const Evaluator& evaluator);

/// Why changed robots fail, a line each: "mass 0.75: …". Empty: none does.
std::vector<std::string> robustness_failures(const std::vector<Changed>& all);

/// robustness.csv: a row a parameter and factor, but for robots that fail.
std::string robustness_csv(const std::vector<Changed>& all, const EvaluationAbout& about);

}  // namespace rehearse::experiment
