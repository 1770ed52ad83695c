#pragma once
// The pendulum: a torque on its axis, too small to lift it in one go (Chatzilygeroudis 2017).

#include <memory>

#include "rehearse/core/options.hpp"
#include "rehearse/scenario/ode_scenario.hpp"

namespace rehearse::robots::pendulum {

struct Physics {
  double m = 1;     // kg
  double l = 1;     // m
  double b = 0.01;  // N m s/rad
  void fields(FieldVisitor& v);
};

/// Options; defaults are those of the authors' code.
struct Options {
  Physics plant;
  double speed_limit = 0;  // rad/s; 0: there is none
  double risk = 0.05;      // the largest probability that an episode exceeds it
  scenario::OdeOptions ode{.box_low = 0.1, .box_high = 2.4, .substeps = 8};
  void fields(FieldVisitor& v);
};

scenario::Scenario make(const Options& options);
std::unique_ptr<scenario::ScenarioBuilder> builder();

system::OdeKernel kernel();  // of equation.hpp

}  // namespace rehearse::robots::pendulum
