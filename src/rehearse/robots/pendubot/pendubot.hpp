#pragma once
// The pendubot: two links, a torque on the first joint alone, to be swung up (Chatzilygeroudis 2018, section V).

#include <memory>
#include <string>

#include "rehearse/core/options.hpp"
#include "rehearse/scenario/policy_options.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::robots::pendubot {

struct Physics {
  double m1 = 0.5, m2 = 0.5;  // kg
  double l1 = 0.5, l2 = 0.5;  // m
  double b1 = 0.1, b2 = 0.1;  // N m s/rad
  void fields(FieldVisitor& v);
};

struct Options {
  Physics plant;
  double start_noise = 0;        // std of every state at the start (the authors' later code: 0.001)
  double measurement_noise = 0;  // std of every measured state (the authors' later code: 0.01)
  double box_low = 0.05;  // of the tunable m1, m2, l1, l2 (the authors' code: 0, where the mass matrix is singular)
  double box_high = 1.2;  // (the authors' code: 1)
  Index substeps = 20;    // of the priors' integrator in a control step
  scenario::PolicyOptions policy{.policy_gain = 5};  // (the paper: 1; the authors' code: 5)
  void fields(FieldVisitor& v);
};

scenario::Scenario make(const Options& options);
std::unique_ptr<scenario::ScenarioBuilder> builder();

/// Vectorised simulator with parameters m1, m2, l1, l2, b1, b2, all fixed at `physics`.
std::shared_ptr<const system::Simulator> make_simulator(const Physics& physics, double dt_s, Index substeps);

}  // namespace rehearse::robots::pendubot
