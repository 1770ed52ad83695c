// The command line as a library, in a program with robots and learners of its own.
#include "rehearse/cli/cli.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rehearse/scenario/ode_builder.hpp"
#include "rehearse/system/plain_kernel.hpp"

namespace rehearse {
namespace {

/// A mass that a force pushes, under this name.
std::unique_ptr<scenario::ScenarioBuilder> mass(const std::string& name) {
  Task task;
  task.states = {{"velocity", "m/s"}};
  task.actions = {{"force", "N", {-1, 1}}};
  task.start_mean = task.start_std = Vector::Zero(1);
  task.dt_s = 0.1;
  task.horizon = 2;
  task.reward = reward::saturating([](const ConstMatrixView& X, VectorView d2) { d2 = X.col(0).cwiseAbs2(); }, 1);
  const system::Ode push = [](const Vector&, const Vector& u, const Vector& phi, Vector& dxdt) { dxdt = u / phi(0); };
  const ParameterSpace parameters({Parameter::fixed("m", 1, "kg")});
  return scenario::make_ode_builder("push a mass",
                                    {.name = name,
                                     .task = task,
                                     .kernel = system::plain_kernel(push, {.states = 1, .actions = 1, .parameters = 1}),
                                     .plant = parameters,
                                     .guesses = {{"same", parameters}}});
}

RobotMaker named(const std::string& name) {
  return [name] { return mass(name); };
}

struct Said {
  int code;
  std::string output, errors;
};

Said run(std::vector<std::string> words, const std::vector<RobotMaker>& robots,
         const std::vector<LearnerFamily>& learners = {}) {
  words.insert(words.begin(), "program");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  const int code = cli(static_cast<int>(words.size()), pointers.data(), robots, learners);
  return {code, ::testing::internal::GetCapturedStdout(), ::testing::internal::GetCapturedStderr()};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Cli, ListsOwnRobotsBesideThoseThatComeWithIt) {
  const Said said = run({"list"}, {named("mass"), named("other-mass")});
  EXPECT_EQ(said.code, 0) << said.errors;
  for (const char* name : {"pendubot", "  mass ", "  other-mass ", "as-published"})
    EXPECT_TRUE(has(said.output, name)) << name;
  EXPECT_TRUE(has(run({"list", "mass"}, {named("mass")}).output, "plant.m"));
}

TEST(Cli, NamesMustBeTheirOwn) {
  const Said built_in = run({"list"}, {named("pendubot")});
  EXPECT_EQ(built_in.code, 2);
  EXPECT_TRUE(has(built_in.errors, "scenario 'pendubot': its name must be its own")) << built_in.errors;
  EXPECT_EQ(built_in.output, "");
  EXPECT_EQ(run({"list"}, {named("mass"), named("mass")}).code, 2);
  const Said slash = run({"list"}, {named("a/b")});
  EXPECT_TRUE(slash.code == 2 && has(slash.errors, "letters, digits")) << slash.errors;
}

TEST(Cli, WhatMakesNothingIsRefused) {
  const Said robot = run({"list"}, {RobotMaker()}), family = run({"list"}, {}, {LearnerFamily()});
  EXPECT_TRUE(robot.code == 2 && has(robot.errors, "a robot is null")) << robot.errors;
  EXPECT_TRUE(family.code == 2 && has(family.errors, "a family of learners is null")) << family.errors;
}

TEST(Cli, ARobotThatCannotBeMadeIsAnErrorAndNoCrash) {
  const RobotMaker broken = []() -> std::unique_ptr<scenario::ScenarioBuilder> {
    throw std::runtime_error("no cable");
  };
  const Said said = run({"list"}, {broken});
  EXPECT_EQ(said.code, 1);
  EXPECT_TRUE(has(said.errors, "no cable")) << said.errors;
}

}  // namespace
}  // namespace rehearse
