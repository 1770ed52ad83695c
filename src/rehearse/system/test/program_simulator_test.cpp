#include "rehearse/system/program_simulator.hpp"

#include <cstdlib>
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/test/test_tools.hpp"
#include "rehearse/files/temporary_folder.hpp"
#include "rehearse/system/test/programs.hpp"

namespace rehearse::system {
namespace {

constexpr double value(Harm harm) { return static_cast<double>(harm); }

/// The harms that end or spoil an answer at once.
const std::vector<Harm> kHarms = {Harm::killed,    Harm::failed,  Harm::left,  Harm::wrong_size,
                                  Harm::no_answer, Harm::partial, Harm::flood, Harm::crashed};
const std::vector<std::string> kEncodings = {"json", "doubles"};

std::shared_ptr<const ProgramSimulator> hostile_simulator(const std::string& encoding, double answer_s = 5,
                                                          const std::string& mark = "") {
  Program program = hostile_program(encoding);
  if (!mark.empty()) program.command.push_back(mark);
  program.answer_s = answer_s;
  return std::make_shared<ProgramSimulator>(program, shift_of(0.25));
}

/// All rows are right, but for those that are said to have none.
void expect_rows(const Simulator& simulator, const Matrix& U, const std::vector<Index>& none) {
  Matrix X(U.rows(), 3), dX(U.rows(), 3);
  for (Index i = 0; i < X.rows(); ++i) X.row(i) = Eigen::RowVector3d(1, 2, 3) * static_cast<double>(i + 1) / 3;
  simulator.change(X, U, Vector{{0.25}}, dX);
  for (Index i = 0; i < X.rows(); ++i) {
    if (std::find(none.begin(), none.end(), i) != none.end()) {
      EXPECT_TRUE(dX.row(i).array().isNaN().all()) << i;
    } else {
      EXPECT_EQ(dX.row(i), (X.row(i).array() + U(i, 0) + 0.25).matrix()) << i;
    }
  }
}

TEST(ProgramSimulator, AnswersToTheBit) {
  for (const std::string& encoding : kEncodings) {
    const auto simulator = hostile_simulator(encoding);
    EXPECT_EQ(simulator->parameters().names(), std::vector<std::string>{"shift"});
    for (const Index rows : {0, 1, 7, 2500}) expect_rows(*simulator, Matrix::Constant(rows, 1, 1.0 / 3), {});
    EXPECT_EQ(simulator->faults().count, 0);
  }
}

TEST(ProgramSimulator, RowsThatCannotBeSimulatedAreNaN) {
  for (const std::string& encoding : kEncodings) {
    Matrix U = Matrix::Ones(4, 1);
    U(2, 0) = value(Harm::no_row);
    expect_rows(*hostile_simulator(encoding), U, {2});
    U(1, 0) = kNaN;  // is not asked
    const auto simulator = hostile_simulator(encoding);
    expect_rows(*simulator, U, {1, 2});
    EXPECT_EQ(simulator->faults().count, 0);
  }
}

TEST(ProgramSimulator, PrintsAreNoAnswers) {
  for (const std::string& encoding : kEncodings) {
    Matrix U = Matrix::Ones(3, 1);
    U(1, 0) = value(Harm::noise);
    const auto simulator = hostile_simulator(encoding);
    expect_rows(*simulator, U, {});
    EXPECT_EQ(simulator->faults().count, 0);
  }
}

TEST(ProgramSimulator, ARowThatDoesHarmIsFoundAndGivenUp) {
  for (const std::string& encoding : kEncodings)
    for (const Harm harm : kHarms) {
      Matrix U = Matrix::Ones(5, 1);
      U(3, 0) = value(harm);
      const auto simulator = hostile_simulator(encoding);
      expect_rows(*simulator, U, {3});
      EXPECT_GT(simulator->faults().count, 0) << value(harm);
      EXPECT_NE(simulator->faults().last.find("hostile_program"), std::string::npos) << simulator->faults().last;
    }
}

TEST(ProgramSimulator, AHungRowIsGivenUpInTime) {
  for (const std::string& encoding : kEncodings) {
    Matrix U = Matrix::Ones(3, 1);
    U(0, 0) = value(Harm::hung);
    const auto simulator = hostile_simulator(encoding, 0.7);
    expect_rows(*simulator, Matrix::Ones(1, 1), {});
    expect_rows(*simulator, U, {0});
    EXPECT_NE(simulator->faults().last.find("within 0.7 s"), std::string::npos);
  }
}

TEST(ProgramSimulator, AFaultThatDoesNotComeAgainChangesNoNumber) {
  const files::TemporaryFolder folder;
  for (const std::string& encoding : kEncodings)
    for (const Harm harm : kHarms) {
      const auto mark = (folder.path() / (encoding + std::to_string(static_cast<int>(harm)))).string();
      const auto simulator = hostile_simulator(encoding, 5, mark);
      Matrix U = Matrix::Ones(5, 1);
      U(1, 0) = value(harm);
      expect_rows(*simulator, U, {});
      EXPECT_EQ(simulator->faults().count, 1) << value(harm);
    }
}

TEST(ProgramSimulator, AnErrorIsSaidInTheProgramsWords) {
  const auto simulator = hostile_simulator("json");
  Matrix U = Matrix::Ones(2, 1);
  U(0, 0) = value(Harm::error);
  expect_rows(*simulator, U, {0});
  EXPECT_NE(simulator->faults().last.find("out of reach"), std::string::npos);
  U(0, 0) = value(Harm::failed);
  expect_rows(*simulator, U, {0});
  EXPECT_NE(simulator->faults().last.find("impossible state"), std::string::npos);
}

TEST(ProgramSimulator, WhereAllRowsDoHarmThoseThatWereAnsweredBeforeDecide) {
  const auto simulator = hostile_simulator("doubles");
  expect_rows(*simulator, Matrix::Ones(1, 1), {});
  const Matrix harmful = Matrix::Constant(20, 1, value(Harm::left));
  std::vector<Index> all(20);
  for (Index i = 0; i < 20; ++i) all[static_cast<std::size_t>(i)] = i;
  expect_rows(*simulator, harmful, all);
  const auto never = hostile_simulator("doubles");
  Matrix X = Matrix::Zero(20, 3), dX(20, 3);
  EXPECT_THROW(never->change(X, harmful, Vector{{0.25}}, dX), Unavailable);
  EXPECT_THROW(change_contained(*never, X, harmful, Vector{{0.25}}, dX), Unavailable);
}

// Seed 1: batches of up to 3 rows, each with a row that does harm at least twice; REHEARSE_FAULTS=500 makes it 2000.
TEST(ProgramSimulator, FaultsSpoilNoOtherRow) {
  const char* given = std::getenv("REHEARSE_FAULTS");
  const int faults = given ? std::stoi(given) : 50;
  Rng rng({.seed = 1});
  for (const std::string& encoding : kEncodings) {
    const auto simulator = hostile_simulator(encoding);
    for (int fault = 0; fault < faults; ++fault) {
      Matrix U = Matrix::Ones(1 + static_cast<Index>(3 * rng.uniform()), 1);
      const auto bad = static_cast<Index>(static_cast<double>(U.rows()) * rng.uniform());
      U(bad, 0) = value(kHarms[static_cast<std::size_t>(8 * rng.uniform())]);
      expect_rows(*simulator, U, {bad});
    }
    EXPECT_GE(simulator->faults().count, 2 * faults);
    expect_rows(*simulator, Matrix::Ones(3, 1), {});
  }
}

TEST(ProgramSimulator, SeveralThreadsHaveAProcessEach) {
  const auto simulator = hostile_simulator("doubles");
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) expect_rows(*simulator, Matrix::Ones(30, 1), {});
    });
  for (std::thread& thread : threads) thread.join();
}

TEST(Program, OneThatCannotBeSpokenWithIsRefusedWithWhy) {
  const auto why = [](Program program, double start_s = 20) -> std::string {
    program.start_s = start_s;
    try {
      require_program(program, ProgramUse::plant);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  const auto contains = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos ? ::testing::AssertionSuccess() : ::testing::AssertionFailure() << text;
  };
  Program program = hostile_program("json");
  EXPECT_EQ(why(program), "");
  program.command = {"no-such-program"};
  EXPECT_TRUE(contains(why(program), "'no-such-program' cannot be started"));
  program.command = {"sh", "-c", "echo sorry >&2; exit 3"};
  EXPECT_TRUE(contains(why(program), "exit status 3; its standard error ends with\nsorry"));
  program.command = {"sleep", "10"};
  EXPECT_TRUE(contains(why(program, 0.5), "did not answer within 0.5 s"));
  program.command = {"sh", "-c", "echo '{\"rehearse\": 2}'; cat"};
  EXPECT_TRUE(contains(why(program), "version 2"));
  program.command = {"sh", "-c", "echo '{\"rehearse\": 1, \"states\": [\"b\", \"a\", \"c\"]}'; cat"};
  EXPECT_TRUE(contains(why(program), "its states are [\"b\",\"a\",\"c\"], the robot's file has [a, b, c]"));
  program.command = {"sh", "-c", "echo '{\"rehearse\": 1, \"encoding\": \"xml\"}'; cat"};
  EXPECT_TRUE(contains(why(program), "\"xml\""));
  program.command = {"sh", "-c", "echo '{\"rehearse\": 1, \"messages\": [\"reset\"]}'; cat"};
  EXPECT_TRUE(contains(why(program), "go together"));
  program.command = {"sh", "-c", "echo '{\"rehearse\": 1, \"messages\": [\"change\", \"end\"]}'; cat"};
  EXPECT_TRUE(contains(why(program), "\"end\" goes with"));
  program.command = {"sh", "-c", "echo '{\"hello\": 1}'; cat"};
  EXPECT_TRUE(contains(why(program), "no \"rehearse\""));
  program.command = {"sh", "-c", "yes"};
  EXPECT_TRUE(contains(why(program), "without an answer"));
}

TEST(ProgramPlant, ASimulatorPlaysTheRobot) {
  const auto plant =
      make_program_plant(hostile_program("json"), shift_of(0.25), {Vector{{1, 2, 3}}, Vector::Zero(3), {}});
  Rng rng({.seed = 1});
  EXPECT_EQ(plant->reset(rng), (Vector{{1, 2, 3}}));
  EXPECT_EQ(plant->step(Vector{{0.5}}), (Vector{{2.75, 4.75, 6.75}}));
  EXPECT_EQ(plant->truth(), (Vector{{2.75, 4.75, 6.75}}));
  const auto why = [&](Harm harm) -> std::string {
    try {
      plant->step(Vector{{value(harm)}});
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(why(Harm::left).find("hostile_program"), std::string::npos);
  plant->reset(rng);
  const std::string none = why(Harm::no_row);
  EXPECT_NE(none.find("' has no next state (null) for the state [1, 2, 3] and the action ["), std::string::npos)
      << none;
}

TEST(ProgramPlant, ARobotKeepsItsState) {
  const auto plant = make_program_plant(robot_program(), shift_of(3), {Vector{{1, 2, 3}}, Vector::Zero(3), {}});
  Rng rng({.seed = 1});
  for (int episode = 0; episode < 2; ++episode) {
    EXPECT_EQ(plant->reset(rng), (Vector{{1, 2, 3}}));
    for (int t = 1; t <= 3; ++t) {
      EXPECT_EQ(plant->step(Vector{{1}}), (Vector{{1.5 + t, 2.5 + t, 3.5 + t}}));
      EXPECT_EQ(plant->truth(), (Vector{{1.0 + t, 2.0 + t, 3.0 + t}}));
    }
    try {
      plant->step(Vector{{1}});
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("the battery is empty"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace rehearse::system
