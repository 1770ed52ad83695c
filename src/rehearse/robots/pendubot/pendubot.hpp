#pragma once
// The pendubot: two links, a torque on the first joint alone, to be swung up (Chatzilygeroudis 2018, section V).

#include <memory>

#include "rehearse/core/options.hpp"
#include "rehearse/scenario/ode_scenario.hpp"

namespace rehearse::robots::pendubot {

struct Physics {
  double m1 = 0.5, m2 = 0.5;  // kg
  double l1 = 0.5, l2 = 0.5;  // m
  double b1 = 0.1, b2 = 0.1;  // N m s/rad
  void fields(FieldVisitor& v);
};

struct Options {
  Physics plant;
  // The authors' later code: start_noise 0.001, measurement_noise 0.01. Their box is [0, 1], with a singular mass
  // matrix at 0; the paper's policy_gain is 1, that of their code 5.
  scenario::OdeOptions ode{.policy = {.policy_gain = 5}};
  void fields(FieldVisitor& v);
};

scenario::Scenario make(const Options& options);
std::unique_ptr<scenario::ScenarioBuilder> builder();

system::OdeKernel kernel();  // of equation.hpp

}  // namespace rehearse::robots::pendubot
