#include "rehearse/robot_file/table.hpp"

#include <gtest/gtest.h>

namespace rehearse::robot_file {
namespace {

TEST(RobotTable, KeepsTheOrderOfTheFile) {
  const toml::table file = files::parse_toml("z = 1\na = 2\n[m]\nb = 3\n", "x.toml");
  std::vector<std::string> names;
  for (const auto& [name, node] : in_order(file)) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"z", "a", "m"}));
}

TEST(RobotTable, TakesFormulasWithTheirLines) {
  const toml::table file = files::parse_toml(
      "one = \"x\"\nnumber = 2.5\nlist = [\"x\", 3]\npair = [1, 2]\n[define]\nb = \"x\"\na = 1\n", "x.toml");
  files::FileViolations violations("x.toml");
  Table table(file, "", violations);
  EXPECT_EQ(table.formula("one").text, "x");
  EXPECT_EQ(table.formula("number").text, "2.5");
  EXPECT_EQ(table.formula("number").line, 2);
  EXPECT_TRUE(table.formula("none").empty());
  EXPECT_EQ(table.formulas("list").size(), 2u);
  EXPECT_EQ(table.formulas("one").size(), 1u);
  Interval pair;
  EXPECT_TRUE(table.interval("pair", pair));
  EXPECT_EQ(pair.high, 2);
  const Definitions definitions = table.definitions("define");
  ASSERT_EQ(definitions.size(), 2u);
  EXPECT_EQ(definitions[0].first, "b");
  table.finish();
  EXPECT_TRUE(violations.empty());
}

}  // namespace
}  // namespace rehearse::robot_file
