#pragma once

#include "rehearse/policy/gait.hpp"
#include "rehearse/robots/hexapod/hexapod.hpp"
#include "rehearse/rollout/execute.hpp"

namespace rehearse::robots::hexapod {

using Leg = Options::Leg;

inline Options without(Leg leg, Leg second = Leg::none) {
  Options options;
  options.damage = leg;
  options.second_damage = second;
  return options;
}

inline Options hurt(Leg leg, Damage kind, Options::Joint joint = Options::Joint::all) {
  Options options = without(leg);
  options.kind = kind;
  options.joint = joint;
  return options;
}

inline Episode tripod_on(const Options& options, std::uint64_t trial = 0) {
  const scenario::Scenario s = make(options);
  return rollout::execute(*s.make_plant(), *s.policy, policy::tripod_gait(), s.task,
                          Rng({.trial = trial, .purpose = Purpose::test}));
}

}  // namespace rehearse::robots::hexapod
