#pragma once
// The cart-pole: a pole that hangs from a cart, to be swung up and balanced by a force on the cart (Deisenroth 2011,
// Chatzilygeroudis 2017).

#include <memory>

#include "rehearse/core/options.hpp"
#include "rehearse/scenario/ode_scenario.hpp"

namespace rehearse::robots::cartpole {

struct Physics {
  double m_pole = 0.5, m_cart = 0.5;  // kg
  double l = 0.5;                     // m
  double b = 0.1;                     // N s/m, between cart and ground
  void fields(FieldVisitor& v);
};

/// Options; defaults are those of the authors' code, unless it says otherwise.
struct Options {
  Physics plant;
  double dt_s = 0.1;   // MC-PILCO (Amadio 2022): 0.05
  Index horizon = 40;  // steps; MC-PILCO: 60
  double shaping = 0;  // share of MC-PILCO's wide reward in the reward; then no learner follows its moments
  double track = 0;    // m, half its length; 0: it has no ends
  double risk = 0.05;  // the largest probability that an episode leaves it
  scenario::OdeOptions ode{.start_noise = 0.001, .measurement_noise = 0.01};  // MC-PILCO: 0.01, 0.01
  void fields(FieldVisitor& v);
};

scenario::Scenario make(const Options& options);
std::unique_ptr<scenario::ScenarioBuilder> builder();

system::OdeKernel kernel();  // of equation.hpp

}  // namespace rehearse::robots::cartpole
