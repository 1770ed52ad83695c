#include "rehearse/robot_file/read_model.hpp"

#include <gtest/gtest.h>

#include "rehearse/robot_file/read.hpp"
#include "rehearse/robot_file/test/example.hpp"

namespace rehearse::robot_file {
namespace {

constexpr const char* kModel = R"xml(<mujoco>
  <option timestep="0.01"/>
  <worldbody>
    <body name="rod">
      <inertial mass="2" pos="0 0 0.5" diaginertia="0.1 0.1 0.01"/>
      <joint name="hinge" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 0 0 1" size="0.02" mass="0"/>
    </body>
  </worldbody>
  <actuator><motor name="motor" joint="hinge"/></actuator>
</mujoco>)xml";

std::optional<std::string> with_rod(const std::string& path) {
  if (path == "rod.xml") return kModel;
  return std::nullopt;
}

/// The example with a model beside its equations.
std::string with_model(const std::string& lines) {
  return example::kSwing + "[dynamics.rod]\nmodel = \"rod.xml\"\n" + lines + "\n[prior.rod]\ndynamics = \"rod\"\n";
}

const std::string kRod =
    "state.angle = \"hinge\"\naction.u = \"motor\"\nparameters.m = { value = 1.5, sets = \"body rod mass\" }";

std::string complaint_of_model(const std::string& lines) { return example::complaint_of(with_model(lines), with_rod); }

TEST(ReadModel, StatesActionsAndParametersAreThoseOfTheModel) {
  const Robot robot = read(with_model(kRod + "\nsubsteps = 5\nkeyframe = \"up\""), "swing.toml", with_rod);
  const auto& model = std::get<ModelSource>(robot.dynamics[1].source);
  EXPECT_EQ(model.path, "rod.xml");
  EXPECT_EQ(model.substeps, 5);
  EXPECT_EQ(model.keyframe, "up");
  ASSERT_EQ(model.states.size(), 2u);
  EXPECT_EQ(model.states[1].name, "angle");
  EXPECT_EQ(model.states[1].terms.front().element, "hinge");
  EXPECT_EQ(model.states[0].kind, mujoco::State::Kind::velocity) << "the rate of an angle";
  EXPECT_EQ(model.states[0].terms.front().element, "hinge");
  EXPECT_EQ(model.actions.front().element, "motor");
  ASSERT_EQ(model.parameters.size(), 1u);
  EXPECT_EQ(model.parameters[0].targets.front().field, "mass");
  EXPECT_EQ(robot.dynamics[1].parameters.front().value, 1.5);
  EXPECT_EQ(robot.files.front().bytes, kModel);
}

TEST(ReadModel, SumsOffsetsAndSeveralTargets) {
  const Robot robot = read(with_model("state.angle = { position = { hinge = 2 }, offset = 0.5 }\n"
                                      "action.u = { joint = \"hinge\" }\n"
                                      "[dynamics.rod.parameters]\n"
                                      "m = { value = 1, scales = [\"body rod mass\", { what = \"body rod inertia 1\", "
                                      "factor = 0.5, power = 2 }], sets = \"option gravity 2\" }"),
                           "swing.toml", with_rod);
  const auto& model = std::get<ModelSource>(robot.dynamics[1].source);
  EXPECT_EQ(model.states[1].offset, 0.5);
  EXPECT_EQ(model.states[0].terms.front().factor, 2);
  EXPECT_EQ(model.states[0].offset, 0) << "a velocity has none";
  EXPECT_EQ(model.actions.front().kind, mujoco::Action::Kind::joint);
  const auto& targets = model.parameters.front().targets;
  ASSERT_EQ(targets.size(), 3u);
  EXPECT_EQ(targets[0].kind, "option");
  EXPECT_EQ(targets[0].component, 2);
  EXPECT_EQ(targets[2].component, 1);
  EXPECT_EQ(targets[2].power, 2);
  EXPECT_EQ(targets[2].apply, mujoco::Target::Apply::scale);
}

TEST(ReadModel, WhatIsWrongIsSaidWithItsLine) {
  EXPECT_EQ(complaint_of_model(kRod), "");
  const auto expect = [](const std::string& lines, const std::string& part) {
    const std::string complaint = complaint_of_model(lines);
    EXPECT_NE(complaint.find(part), std::string::npos) << complaint;
    EXPECT_EQ(complaint.rfind("swing.toml: line ", 0), 0u) << complaint;
    EXPECT_EQ(complaint.find("/tmp"), std::string::npos) << complaint;
  };
  expect("state.angle = \"hing\"\naction.u = \"motor\"",
         "line 44: [dynamics.rod]: state 'angle': there is no joint 'hing', did you mean 'hinge'?");
  expect("state.angel = \"hinge\"\naction.u = \"motor\"", "there is no state 'angel', did you mean 'angle'?");
  expect("state.angle = \"hinge\"\naction.v = \"motor\"", "there is no action 'v', did you mean 'u'?");
  expect("state.angle = \"hinge\"\naction.u = \"moto\"", "line 45: [dynamics.rod]: action 'moto'");
  expect("state.angle = \"hinge\"", "no actuator");
  expect("state.angle = 3", "must be the name of a joint");
  expect("state.angle = { velocity = \"hinge\", position = \"hinge\" }", "must be one of position, velocity");
  expect(kRod + "\nparameters.k = 2", "must say what it sets or scales");
  expect(kRod + "\nparameters.k = { value = 2, sets = \"mass of rod\" }",
         "there is no kind 'mass' (known: body, joint");
  expect(kRod + "\nparameters.k = { value = 2, sets = \"body rod\" }", "KIND ELEMENT FIELD");
  expect(kRod + "\nparameters.k = { value = 2, sets = \"body rot mass\" }", "line 47: [dynamics.rod]: parameter 'k'");
  expect(kRod + "\nparameters.k = { value = 2, sets = \"body rod maas\" }", "mass");
  expect(kRod + "\nparameters.\"rod.mass\" = { value = 2, sets = \"body rod mass\" }",
         "line 47: the name of parameter 'rod.mass' must be of letters, digits, - and _");
  expect(kRod + "\nsubsteps = 0", "substeps = 0, must be");
  expect(kRod + "\nkeyframe = \"up\"", "line 47: [dynamics.rod]: keyframe");
  expect("state.angle = { position = { hinge = \"2\" } }\naction.u = \"motor\"",
         "line 44: the factor of hinge must be a number");
  expect("state.angle = { position = \"hinge\", component = 4 }\naction.u = \"motor\"", "line 44");
  expect(kRod + "\nfiles = [\"mesh.stl\"]", "'mesh.stl' is no file");
}

}  // namespace
}  // namespace rehearse::robot_file
