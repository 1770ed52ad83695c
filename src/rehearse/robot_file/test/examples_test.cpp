// The files of examples/robots, and the built-in robots that some of them are.
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "rehearse/robot_file/robot_file.hpp"
#include "rehearse/robot_file/test/example.hpp"
#include "rehearse/robot_file/try_out.hpp"
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
  const Tried tried = try_out(scenario);
  EXPECT_EQ(tried.broken, std::vector<std::string>{});
  EXPECT_EQ(tried.end, "");
  ASSERT_FALSE(tried.priors.empty());
  for (const PriorTried& prior : tried.priors) {
    EXPECT_EQ(prior.failed, 0);
    EXPECT_EQ(prior.idle, std::vector<std::string>{}) << prior.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Examples, EachRobotFile, ::testing::Values("pendulum", "acrobot"));

// Not to the bit: the built-in equation is written with other associations and fused multiply-adds, and turns sines and
// cosines along, where a file's integrates them.
TEST(RobotFiles, APendulumIsThatOfTheProgram) {
  const scenario::Scenario file = example("pendulum"), built_in = robots::pendulum::builder()->build();
  const Matrix X = 3 * Matrix::Random(100, 2), U = 2.5 * Matrix::Random(100, 1);
  Matrix a(100, 2), b(100, 2);
  file.oracle->change(X, U, file.oracle->parameters().values(), a);
  built_in.oracle->change(X, U, built_in.oracle->parameters().values(), b);
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-9) << "rounding, and polynomials of the turn of an angle";
  Vector of_file(100), of_program(100);
  file.task.reward(X, U, X, of_file);
  built_in.task.reward(X, U, X, of_program);
  EXPECT_LT((of_file - of_program).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace
}  // namespace rehearse::robot_file
