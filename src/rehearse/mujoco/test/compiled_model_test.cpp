#include "rehearse/mujoco/compiled_model.hpp"

#include <gtest/gtest.h>

#include "rehearse/mujoco/test/robots.hpp"

namespace rehearse::mujoco {
namespace {

std::string compile_complaint(double dt_s, Index substeps) {
  return complaint_of([&] {
    ModelDescription model = pendulum_model();
    model.dt_s = dt_s;
    model.substeps = substeps;
    CompiledModel compiled(model);
  });
}

TEST(CompiledModel, AControlStepIsAWholeNumberOfTimesteps) {
  EXPECT_EQ(compile_complaint(0.0004, 0),
            "dt_s = 0.0004 is 0.4 timesteps of the model (0.001 s), must be a whole number; substeps = 1 makes it one");
  EXPECT_EQ(
      compile_complaint(0.0105, 0),
      "dt_s = 0.0105 is 10.5 timesteps of the model (0.001 s), must be a whole number; substeps = 11 makes it one");
  EXPECT_EQ(compile_complaint(0, 0), "dt_s = 0, must be > 0");
  EXPECT_EQ(compile_complaint(0.1, -1), "substeps = -1, must be ≥ 1, or 0 for the model's own");
  EXPECT_EQ(compile_complaint(0.05, 0), "");
}

TEST(CompiledModel, SubstepsSetTheTimestep) {
  ModelDescription model = pendulum_model();
  EXPECT_EQ(CompiledModel(model).substeps(), 50);
  model.substeps = 7;
  const CompiledModel compiled(model);
  EXPECT_EQ(compiled.substeps(), 7);
  EXPECT_DOUBLE_EQ(compiled.original().opt.timestep, kControlStep / 7);
}

TEST(CompiledModel, WhatIsWrongIsNamedAtOnce) {
  ModelDescription model = pendulum_model();
  model.dt_s = -1;
  model.keyframe = "upp";
  model.states[0].terms[0].element = "hing";
  model.actions = {{"moto"}, {"hinge", Action::Kind::joint}, {"hinge", Action::Kind::joint}};
  EXPECT_EQ(complaint_of([&] { CompiledModel compiled(model); }),
            "dt_s = -1, must be > 0\n"
            "keyframe: there is no key 'upp', did you mean 'up'? (known: up)\n"
            "state 'angle': there is no joint 'hing', did you mean 'hinge'? (known: hinge)\n"
            "action 'moto': there is no actuator 'moto', did you mean 'motor'? (known: motor)\n"
            "action 'hinge' stands twice");
}

}  // namespace
}  // namespace rehearse::mujoco
