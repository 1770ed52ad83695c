#include "rehearse/robot_file/read_states.hpp"

#include <gtest/gtest.h>

namespace rehearse::robot_file {
namespace {

struct ReadStates {
  explicit ReadStates(const std::string& text) {
    const toml::table file = files::parse_toml(text, "x.toml");
    files::FileViolations violations("x.toml");
    Table table(file, "", violations);
    expression::Formulas names;
    states = read_states(table, names, violations);
    try {
      violations.throw_if_any();
    } catch (const InvalidInput& error) {
      complaint = error.what();
    }
  }
  std::vector<State> states;
  std::string complaint;
};

std::string states_of(const std::string& first, const std::string& second) {
  return "[[state]]\nname = \"q1\"\n" + first + "\n[[state]]\nname = \"q2\"\n" + second + "\n";
}

TEST(ReadStates, AreInTheOrderOfTheFile) {
  const ReadStates read(states_of("unit = \"rad\"\nangle = true\nstart = 2", "input = false\nrate = \"q1\""));
  EXPECT_EQ(read.complaint, "");
  ASSERT_EQ(read.states.size(), 2u);
  EXPECT_EQ(read.states[0].variable.kind, StateKind::angle);
  EXPECT_EQ(read.states[0].start, 2);
  EXPECT_EQ(read.states[1].variable.kind, StateKind::omitted);
  EXPECT_EQ(read.states[1].variable.rate, "q1");
  EXPECT_TRUE(ReadStates("").states.empty());
}

TEST(ReadStates, NamesOfOthersAreSaidWithLineAndTheNearest) {
  const auto expect = [](const std::string& first, const std::string& second, const std::string& said) {
    EXPECT_EQ(ReadStates(states_of(first, second)).complaint, "x.toml: line " + said);
  };
  expect("rate = \"q\"", "", "3: state q1: its rate 'q' is not another state, did you mean 'q2'?");
  expect("rate = \"q1\"", "", "3: state q1: its rate 'q1' is not another state, did you mean 'q2'?");
  expect("angle = true", "angle = true\nparent = \"q11\"",
         "7: state q2: its parent 'q11' is not another state, did you mean 'q1'?");
  expect("", "angle = true\nparent = \"q1\"", "7: state q2: q1 cannot carry it, both must be angles");
  expect("unit = \"deg\"\nangle = true", "",
         "3: state q1: an angle is in rad; a log in degrees says so in its header: q1 [deg]");
  EXPECT_EQ(ReadStates(states_of("rate = \"q2\"", "rate = \"q1\"")).complaint,
            "x.toml: line 3: state q1: its rates go in a circle\nx.toml: line 6: state q2: its rates go in a circle");
  EXPECT_EQ(
      ReadStates(states_of("angle = true\nparent = \"q2\"", "angle = true\nparent = \"q1\"")).complaint,
      "x.toml: line 4: state q1: its parents go in a circle\nx.toml: line 8: state q2: its parents go in a circle");
  EXPECT_EQ(ReadStates("[[state]]\nname = \"q\"\nrate = \"dq\"\n").complaint,
            "x.toml: line 3: state q: its rate 'dq' is not another state");
}

}  // namespace
}  // namespace rehearse::robot_file
