#include "rehearse/robot_file/read_dynamics.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/robot_file/read.hpp"
#include "rehearse/robot_file/test/example.hpp"

namespace rehearse::robot_file {
namespace {

/// The example with a program beside its equations, which says so.
std::string with_program(const std::string& lines) { return example::kSwing + "[dynamics.other]\n" + lines + "\n"; }

std::optional<std::string> folder(const std::string& path) {
  if (path == "sim.py") return "print()";
  if (path == "data/masses.csv") return "1,2";
  return std::nullopt;
}

std::string complaint_of_program(const std::string& lines) {
  return example::complaint_of(with_program(lines), folder);
}

TEST(ReadDynamics, AProgramHasItsFilesAndItsTimes) {
  const Robot robot = read(with_program("program = [\"python3\", \"-u\", \"sim.py\", \"0.5\", \"0.5\"]\nfiles = "
                                        "[\"data/masses.csv\"]\nanswer_s = 3\nparameters.k = 2"),
                           "swing.toml", folder);
  ASSERT_EQ(robot.dynamics.size(), 2u);
  const auto& program = std::get<ProgramSource>(robot.dynamics[1].source);
  EXPECT_EQ(program.command, (std::vector<std::string>{"python3", "-u", "sim.py", "0.5", "0.5"}));
  EXPECT_EQ(program.answer_s, 3);
  EXPECT_EQ(program.start_s, 30);
  ASSERT_EQ(robot.files.size(), 2u);
  EXPECT_EQ(robot.files[0].path, "sim.py");
  EXPECT_EQ(robot.files[1].bytes, "1,2");
  EXPECT_EQ(robot.dynamics[1].parameters.front().name, "k");
}

TEST(ReadDynamics, HostsAndModulesAreNoFiles) {
  EXPECT_EQ(complaint_of_program("program = [\"ssh\", \"robot.local\"]").find("no file"), std::string::npos);
  EXPECT_EQ(complaint_of_program("program = [\"python3\", \"-m\", \"lab.driver\"]").find("no file"), std::string::npos);
}

TEST(ReadDynamics, AParameterHasAWordForItsName) {
  for (const std::string name : {"leg.mass", "leg mass", "leg=1", "leg,mass"}) {
    const std::string complaint = "the name of parameter '" + name + "' must be of letters, digits, - and _";
    EXPECT_EQ(complaint_of_program("program = [\"sim\"]\nparameters.leg = 1\nparameters.\"" + name + "\" = 2"),
              "swing.toml: line 45: " + complaint);
    const std::string equations = example::with("{ m = 1,", "{ \"" + name + "\" = 1, m = 1,");
    EXPECT_EQ(example::complaint_of(equations), "swing.toml: line 33: " + complaint);
  }
  for (const std::string name : {"leg", "leg_mass", "leg-mass", "μ", "größe_2"})
    EXPECT_EQ(complaint_of_program("program = [\"sim\"]\nparameters.\"" + name + "\" = 2"), "");
}

TEST(ReadDynamics, WhatIsWrongWithAProgramIsSaid) {
  const auto expect = [](const std::string& lines, const std::string& part) {
    const std::string complaint = complaint_of_program(lines);
    EXPECT_NE(complaint.find(part), std::string::npos) << complaint;
    EXPECT_EQ(complaint.rfind("swing.toml: line ", 0), 0u) << complaint;
  };
  expect("program = []", "a program and its arguments");
  expect("program = 3", "program");
  expect("program = [\"cat\"]\nfiles = [\"data\"]",
         "'data' is no file in the folder of the robot's file; of a folder, each file is named");
  expect("program = [\"python3\", \"simm.py\"]", "'simm.py' is no file in the folder of the robot's file");
  expect("program = [\"./sim\"]", "'./sim' is no file");
  expect("program = \"python3 sim.py\"", "robot's file; a command is a list: [\"python3\", \"robot.py\"]");
  expect("program = [\"python3\", \"../sim.py\"]", "'../sim.py' is no file");
  expect("program = [\"sim\"]\nfiles = [\"none\"]", "'none' is no file");
  expect("program = [\"sim\"]\nanswer_s = 0", "answer_s = 0, must be > 0");
  expect("program = [\"sim\"]\nrate.angle = \"1\"", "line 44: a dynamics has program and rate, must have one of them");
  expect("program = [\"sim\"]\nmodel = \"m.xml\"", "line 44: a dynamics has program and model, must have one of them");
  EXPECT_EQ(complaint_of_program("program = [\"sim\"]\ndefine.a = \"1\"\nrate.angle = \"a\"").find("unknown key"),
            std::string::npos)
      << "what either of both may have is not wrong";
  expect("progam = [\"sim\"]", "unknown key 'progam' in [dynamics.other], did you mean 'program'?");
}

}  // namespace
}  // namespace rehearse::robot_file
