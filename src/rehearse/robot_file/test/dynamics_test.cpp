#include "rehearse/robot_file/dynamics.hpp"

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/test/test_tools.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/files/temporary_folder.hpp"
#include "rehearse/robot_file/read.hpp"
#include "rehearse/robot_file/robot_file.hpp"
#include "rehearse/robot_file/test/example.hpp"

namespace rehearse::robot_file {
namespace {

// The example's pendulum, at a thousandth of its rates: the answer to each row is the row.
constexpr const char* kEcho = R"py(
import json, sys
hello = json.loads(sys.stdin.readline())
print(json.dumps({"rehearse": 1}), flush=True)
for line in sys.stdin:
    asked = json.loads(line)["change"]
    rows = [[0.001 * (u[0] + asked["parameters"][0]), 0.01 * x[0]] for x, u in zip(asked["states"], asked["actions"])]
    print(json.dumps({"change": rows}), flush=True)
)py";

std::string with_echo() {
  return example::with("[prior.heavy]",
                       "[dynamics.echo]\nprogram = [\"python3\", \"echo.py\"]\nparameters = { a = 2 }\n"
                       "[prior.echo]\ndynamics = \"echo\"\ntune.a = [1, 3]\n[prior.heavy]");
}

std::optional<std::string> echo_folder(const std::string& path) {
  if (path == "echo.py") return kEcho;
  return std::nullopt;
}

TEST(Dynamics, APriorMayBeAProgram) {
  const scenario::Scenario scenario = builder(with_echo(), "swing.toml", echo_folder)->build();
  ASSERT_TRUE(scenario.require_ready);
  EXPECT_NO_THROW(scenario.require_ready(scenario::PlantUse::left_alone));
  const scenario::NamedPrior& prior = scenario.priors.front();
  ASSERT_EQ(prior.name, "echo");
  Matrix X{{1, 2}, {3, 4}}, U{{0.5}, {1}}, dX(2, 2);
  prior.simulator->change(X, U, prior.parameters.values(), dX);
  EXPECT_EQ(dX, (Matrix{{0.001 * 2.5, 0.01}, {0.001 * 3, 0.01 * 3}}));
}

TEST(Dynamics, AProgramThatCannotBeAskedIsSaidBeforeARun) {
  const auto broken = [](const std::string&) -> std::optional<std::string> { return "import no_such_module"; };
  const scenario::Scenario scenario = builder(with_echo(), "swing.toml", broken)->build();
  try {
    scenario.require_ready(scenario::PlantUse::left_alone);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("no_such_module"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("\n`files = […]` names"), std::string::npos) << error.what();
  }
}

/// The programs of such names, in the order in which they were started to see whether they answer.
std::string started(const std::string& robot, scenario::PlantUse plant) {
  constexpr const char* kLogged = R"py(
import json, sys
with open(sys.argv[2], "a") as log:
    log.write(sys.argv[1] + " ")
sys.stdin.readline()
print(json.dumps({"rehearse": 1, "messages": ["change", "reset", "step"]}), flush=True)
)py";
  const files::TemporaryFolder folder;
  const std::filesystem::path log = folder.path() / "log";
  std::string text = robot;
  for (const std::string name : {"driver", "model", "spare"})
    text +=
        fmt::format("[dynamics.{0}]\nprogram = [\"python3\", \"logged.py\", \"{0}\", \"{1}\"]\n", name, log.string());
  const auto file = [&](const std::string& path) -> std::optional<std::string> {
    return path == "logged.py" ? std::optional<std::string>(kLogged) : std::nullopt;
  };
  const scenario::Scenario scenario = builder(text, "swing.toml", file)->build();
  if (scenario.require_ready) scenario.require_ready(plant);
  return std::filesystem::exists(log) ? files::read_file(log) : "";
}

TEST(Dynamics, TheProgramOfAPlantThatIsLeftAloneIsNotStarted) {
  using scenario::PlantUse;
  const std::string of_plant = example::with("[plant]", "[plant]\ndynamics = \"driver\"");
  EXPECT_EQ(started(of_plant, PlantUse::left_alone), "");
  EXPECT_EQ(started(of_plant, PlantUse::driven), "driver ");
  const std::string of_both = of_plant + "[prior.model]\ndynamics = \"model\"\n";
  EXPECT_EQ(started(of_both, PlantUse::left_alone), "model ");
  EXPECT_EQ(started(of_both, PlantUse::driven), "model driver ");
  const std::string of_one = of_plant + "[prior.same]\ndynamics = \"driver\"\n";
  for (const PlantUse use : {PlantUse::left_alone, PlantUse::driven}) EXPECT_EQ(started(of_one, use), "driver ");
}

// It can be a plant, which the run drives, and would fail as a prior in the first trial.
TEST(Dynamics, AProgramWithoutChangesIsNoPriorAndNoOracle) {
  const auto file = [](const std::string&) -> std::optional<std::string> {
    return "import json, sys\nsys.stdin.readline()\n"
           "print(json.dumps({'rehearse': 1, 'messages': ['reset', 'step']}), flush=True)\n";
  };
  const std::string of_plant = example::with("[plant]", "[plant]\ndynamics = \"driver\"") +
                               "[dynamics.driver]\nprogram = [\"python3\", \"driver.py\"]\n";
  constexpr const char* kWhy = "it does not understand the message \"change\", so it can be a plant but not a prior";
  const scenario::Scenario scenario = builder(of_plant, "swing.toml", file)->build();
  EXPECT_NO_THROW(scenario.require_ready(scenario::PlantUse::driven));
  const std::string of_oracle = message_of<InvalidInput>([&] { scenario.require_oracle(); });
  EXPECT_NE(of_oracle.find(kWhy), std::string::npos) << of_oracle;
  const scenario::Scenario both =
      builder(of_plant + "[prior.same]\ndynamics = \"driver\"\n", "swing.toml", file)->build();
  const std::string of_prior = message_of<InvalidInput>([&] { both.require_ready(scenario::PlantUse::driven); });
  EXPECT_NE(of_prior.find(kWhy), std::string::npos) << of_prior;
}

constexpr const char* kTwoRods = R"xml(<mujoco>
  <option timestep="0.01"/>
  <worldbody>
    <body>
      <joint name="hinge" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 0 0 1" size="0.02"/>
      <body pos="0 0 1">
        <joint name="j2" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0 0 1" size="0.02"/>
      </body>
    </body>
  </worldbody>
  <actuator><motor name="motor" joint="hinge"/></actuator>
</mujoco>)xml";

std::string with_rods() {
  return example::with("[plant]",
                       "[dynamics.rods]\nmodel = \"rods.xml\"\nstate.angle = \"hinge\"\naction.u = \"motor\"\n"
                       "[plant]\ndynamics = \"rods\"\n[prior.rods]\ndynamics = \"rods\"");
}

TEST(Dynamics, PartsOfAModelThatNoStateGivesAreSaid) {
  const auto folder = [](const std::string&) -> std::optional<std::string> { return kTwoRods; };
  const scenario::Scenario scenario = builder(with_rods(), "swing.toml", folder)->build();
  const std::vector<std::string> lines = {
      "not among the states, so each step begins with it at rest: position of joint 'j2'",
      "not among the states, so each step begins with it at rest: velocity of joint 'j2'"};
  ASSERT_EQ(scenario.priors.size(), 2u);
  EXPECT_EQ(scenario.priors[0].lacks, lines);
  EXPECT_TRUE(scenario.priors[1].lacks.empty()) << "equations";
  EXPECT_EQ(scenario.oracle_lacks, lines);
}

TEST(Dynamics, ATimestepThatIsNotThePlantsIsSaid) {
  const auto folder = [](const std::string&) -> std::optional<std::string> { return kTwoRods; };
  const std::string rods = "[dynamics.rods]\nmodel = \"rods.xml\"\nstate.angle = \"hinge\"\naction.u = \"motor\"\n";
  std::string coarse = rods;
  coarse.replace(coarse.find("rods]"), 5, "coarse]").append("substeps = 4\n");
  const std::string text =
      example::with("[plant]", rods + coarse + "[plant]\ndynamics = \"rods\"\n[prior.coarse]\ndynamics = \"coarse\"");
  const scenario::Scenario scenario = builder(text, "swing.toml", folder)->build();
  EXPECT_EQ(scenario.priors.front().lacks.back(),
            "MuJoCo does 10 timesteps a control step in the plant, 4 in the prior (substeps, or the timestep of the "
            "model)");
}

TEST(Dynamics, AModelIsCompiledOnceForAllThatIsMadeOfIt) {
  const auto folder = [](const std::string&) -> std::optional<std::string> { return kTwoRods; };
  const scenario::MakeBuilder make = maker(with_rods(), "swing.toml", folder);
  const char* const before = std::getenv("TMPDIR");
  const std::string usual = before ? before : "";
  ::setenv("TMPDIR", "/nowhere", 1);  // another time, the compiler would not find its file
  EXPECT_THROW(files::TemporaryFolder(), std::exception);
  std::vector<Vector> steps;
  for (int i = 0; i < 2; ++i) {
    const scenario::Scenario scenario = make()->build();
    EXPECT_TRUE(scenario.drawing);
    for (const auto& simulator : {scenario.oracle, scenario.priors.front().simulator}) {
      Matrix dX(1, 2);
      simulator->change(Matrix{{0, 3}}, Matrix{{1}}, simulator->parameters().values(), dX);
      steps.emplace_back(dX.row(0));
    }
    Rng rng({.seed = 1});
    EXPECT_TRUE(scenario.make_plant()->reset(rng).allFinite());
  }
  for (const Vector& step : steps) EXPECT_EQ(step, steps.front());
  usual.empty() ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", usual.c_str(), 1);
}

TEST(Dynamics, AFileThatAModelIncludesMustBeNamed) {
  const auto folder = [](const std::string&) -> std::optional<std::string> {
    return "<mujoco><include file=\"more.xml\"/></mujoco>";
  };
  const std::string complaint = example::complaint_of(with_rods(), folder);
  EXPECT_NE(complaint.find("more.xml"), std::string::npos) << complaint;
  EXPECT_NE(complaint.find("(MuJoCo sees only files named in `files = […]`)"), std::string::npos) << complaint;
}

TEST(Dynamics, EquationsNeedNobody) {
  EXPECT_FALSE(builder(example::kSwing, "swing.toml", example::no_files)->build().require_ready);
}

}  // namespace
}  // namespace rehearse::robot_file
