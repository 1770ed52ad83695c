#pragma once
// The pendulum: a torque on its axis, too small to lift it in one go (Chatzilygeroudis 2017).

#include <memory>

#include "rehearse/core/options.hpp"
#include "rehearse/scenario/policy_options.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::robots::pendulum {

struct Physics {
  double m = 1;     // kg
  double l = 1;     // m
  double b = 0.01;  // N m s/rad
  void fields(FieldVisitor& v);
};

/// Of the authors' code.
struct Options {
  Physics plant;
  double start_noise = 0;        // std of every state at the start
  double measurement_noise = 0;  // std of every measured state
  double box_low = 0.1;          // of the tunable m, l
  double box_high = 2.4;
  Index substeps = 8;  // of the priors' integrator in a control step
  scenario::PolicyOptions policy;
  void fields(FieldVisitor& v);
};

scenario::Scenario make(const Options& options);
std::unique_ptr<scenario::ScenarioBuilder> builder();

}  // namespace rehearse::robots::pendulum
