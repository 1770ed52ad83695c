// The files of examples/robots, and the built-in robots that some of them are.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "rehearse/check/try_out.hpp"
#include "rehearse/robot_file/robot_file.hpp"
#include "rehearse/robot_file/test/example.hpp"
#include "rehearse/robots/cartpole/cartpole.hpp"
#include "rehearse/robots/pendubot/pendubot.hpp"
#include "rehearse/robots/pendulum/pendulum.hpp"

namespace rehearse::robot_file {
namespace {

scenario::Scenario example(const std::string& name) {
  const auto examples = std::filesystem::path(TEST_DATA_DIR "/../../../../../examples/robots").lexically_normal();
  const std::string file = examples / (name + ".toml");
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return builder(text.str(), file, example::no_files)->build();
}

class EachRobotFile : public ::testing::TestWithParam<const char*> {};

TEST_P(EachRobotFile, IsInOrder) {
  const scenario::Scenario scenario = example(GetParam());
  const check::Tried tried = check::try_out(scenario);
  EXPECT_EQ(tried.broken, std::vector<std::string>{});
  EXPECT_FALSE(tried.end);
  ASSERT_FALSE(tried.priors.empty());
  for (const check::PriorTried& prior : tried.priors) {
    EXPECT_EQ(prior.failed, 0);
    EXPECT_EQ(prior.idle, std::vector<std::string>{}) << prior.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Examples, EachRobotFile,
                         ::testing::Values("pendulum", "cartpole", "pendubot", "acrobot", "arm", "quadrotor"));

struct Same {
  const char* file;
  std::unique_ptr<scenario::ScenarioBuilder> (*built_in)();
};
void PrintTo(const Same& same, std::ostream* out) { *out << same.file; }

/// A robot that is built in, and the file that describes it, too.
class EachBuiltInRobot : public ::testing::TestWithParam<Same> {};

void expect_same_changes(const system::Simulator& of_file, const Vector& phi, const system::Simulator& of_program,
                         const Vector& same_phi, const Task& task) {
  const Index n = 100;
  const Matrix X = 3 * Matrix::Random(n, task.state_size()),
               U = task.actions[0].bounds.high * Matrix::Random(n, task.action_size());
  Matrix a(n, X.cols()), b(n, X.cols());
  of_file.change(X, U, phi, a);
  of_program.change(X, U, same_phi, b);
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-7) << "rounding, and steps of the integration";
}

// Not to the bit: the built-in equation is written with other associations and fused multiply-adds, and some turn sines
// and cosines along, where a file's integrates them.
TEST_P(EachBuiltInRobot, IsThatOfItsFile) {
  const scenario::Scenario file = example(GetParam().file), built_in = GetParam().built_in()->build();
  const Task &task = file.task, &same = built_in.task;
  expect_same_changes(*file.oracle, file.oracle->parameters().values(), *built_in.oracle,
                      built_in.oracle->parameters().values(), task);
  for (const scenario::NamedPrior& prior : built_in.priors) {
    const auto of_file = std::find_if(file.priors.begin(), file.priors.end(),
                                      [&](const scenario::NamedPrior& each) { return each.name == prior.name; });
    if (of_file == file.priors.end()) continue;  // the pendulum's file begins robots, with one guess
    EXPECT_EQ(of_file->parameters.values(), prior.parameters.values()) << prior.name;
    EXPECT_EQ(of_file->parameters.names(), prior.parameters.names());
    expect_same_changes(*of_file->simulator, of_file->parameters.values(), *prior.simulator, prior.parameters.values(),
                        task);
  }
  EXPECT_EQ(file.priors.front().name, built_in.priors.front().name);
  EXPECT_EQ(task.start_mean, same.start_mean);
  EXPECT_EQ(task.start_std, same.start_std);
  EXPECT_EQ(task.horizon, same.horizon);
  const Matrix X = 3 * Matrix::Random(100, task.state_size()), U = Matrix::Zero(100, task.action_size());
  Vector of_file(100), of_program(100);
  task.reward(X, U, X, of_file);
  same.reward(X, U, X, of_program);
  EXPECT_LT((of_file - of_program).cwiseAbs().maxCoeff(), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Examples, EachBuiltInRobot,
                         ::testing::Values(Same{"pendulum", robots::pendulum::builder},
                                           Same{"cartpole", robots::cartpole::builder},
                                           Same{"pendubot", robots::pendubot::builder}));

}  // namespace
}  // namespace rehearse::robot_file
