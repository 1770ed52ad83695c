#include "rehearse/experiment/catalogue.hpp"

#include <optional>

#include <gtest/gtest.h>

#include "fake.hpp"

namespace rehearse::experiment {
namespace {

TEST(Catalogue, FindsBuildersByName) {
  const Catalogue catalogue = fake::catalogue();
  EXPECT_EQ(catalogue.learner("echo-alone")->name(), "echo-alone");
  EXPECT_EQ(catalogue.scenario("line")->name(), "line");
  EXPECT_FALSE(catalogue.learner("line") || catalogue.scenario("echo") || catalogue.learner("pilco"));
  EXPECT_EQ(catalogue.learner_builders().size(), 2u);
}

TEST(Catalogue, MakesTheScenarioOfThatNameAlone) {
  Catalogue catalogue = fake::catalogue();
  catalogue.scenarios.insert(catalogue.scenarios.begin(),
                             {"costly", []() -> std::unique_ptr<scenario::ScenarioBuilder> {
                                throw std::logic_error("is made though nobody asks");
                              }});
  EXPECT_TRUE(catalogue.scenario("line"));
  EXPECT_FALSE(catalogue.scenario("lien"));
  EXPECT_NE(catalogue.why_missing("scenario", "lien").find("(known: costly, line)"), std::string::npos);
}

TEST(Catalogue, MakesNewBuildersForEveryCall) {
  const auto options = [](scenario::ScenarioBuilder& builder) {
    return list_fields([&](FieldVisitor& v) { builder.fields(v); });
  };
  const Catalogue catalogue = fake::catalogue();
  const auto one = catalogue.scenario("line"), other = catalogue.scenario("line");
  EXPECT_EQ(options(*one), options(*other));
  EXPECT_TRUE(set_field([&](FieldVisitor& v) { one->fields(v); }, "noise", "3"));
  EXPECT_NE(options(*one), options(*other));
}

TEST(Catalogue, ThrowsWhereAScenarioIsMissing) {
  EXPECT_EQ(fake::catalogue().scenario_or_throw("line")->name(), "line");
  EXPECT_THROW(fake::catalogue().scenario_or_throw("lien"), InvalidInput);
}

TEST(Catalogue, SaysWhyThereIsNone) {
  EXPECT_EQ(fake::catalogue().why_missing("learner", "pilco"), "learner 'pilco' is not built: not written yet");
  EXPECT_EQ(Catalogue{}.why_missing("learner", "echo"), "unknown learner 'echo': there are none");
  EXPECT_EQ(Catalogue{.of_run = true}.why_missing("scenario", "cart"),
            "unknown scenario 'cart': there are none; a robot in C++ is known only to the program that began the run");
  EXPECT_EQ(unknown_name("robot", "lien", {"arm", "line"}),
            "unknown robot 'lien', did you mean 'line'? (known: arm, line)");
}

TEST(Catalogue, NamesNoLearnersThatBeginWithAPolicyWhereThereAreNone) {
  EXPECT_EQ(fake::catalogue().why_no_start("echo"), "learner echo cannot begin with a policy");
}

TEST(Catalogue, SaysWhereTwoRobotsOfOneNameDiffer) {
  Catalogue catalogue;
  int reads = 0;
  catalogue.read_robot = [&reads](std::string_view, const std::string&, const scenario::ReadFile&) {
    ++reads;
    return [] { return std::make_unique<fake::LineBuilder>(); };
  };
  const Catalogue one = catalogue.with_robot("a = 1\nb = 2\n", "line.toml", fake::test_folder());
  const auto complaint_of = [&](const std::string& text) {
    try {
      (void)one.with_robot(text, "other.toml", fake::test_folder());
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(complaint_of("a = 1\nb = 2\n"), "none");
  EXPECT_TRUE(one.scenario("line") && one.scenario("line"));
  EXPECT_EQ(reads, 1);
  const std::string both = "other.toml and line.toml are two robots of one name, 'line': ";
  EXPECT_EQ(complaint_of("a = 1\nb = 3\n"), both + "`b = 3` in the one, `b = 2` in the other");
  EXPECT_EQ(complaint_of("a = 1\n"), both + "`` in the one, `b = 2` in the other");
  EXPECT_EQ(complaint_of("a = 1\r\nb = 2\r\n"), both + "their lines end differently");
}

// Arguments of programs are asked for, which may be scripts.
TEST(Catalogue, ATextThatIsTooLongForAPathIsNoFileOfARobot) {
  Catalogue catalogue;
  std::optional<std::string> bytes = "not asked";
  catalogue.read_robot = [&](std::string_view, const std::string&, const scenario::ReadFile& read_file) {
    bytes = read_file(std::string(5000, 'x'));
    return [] { return std::make_unique<fake::LineBuilder>(); };
  };
  EXPECT_EQ(catalogue.with_robot("a robot", "line.toml", fake::test_folder()).robots.size(), 1u);
  EXPECT_FALSE(bytes.has_value());
}

TEST(Catalogue, ARobotsChecksumIsOfAllThatDescribesIt) {
  const RobotFile robot{"mine", "mine.toml", "text", {{"a.py", "one"}}};
  const std::string checksum = checksum_of(robot);
  EXPECT_EQ(checksum.size(), 16);
  EXPECT_EQ(checksum_of({"mine", "elsewhere/mine.toml", "text", robot.files}), checksum) << "not of where it is";
  EXPECT_NE(checksum_of({"mine", "mine.toml", "other", robot.files}), checksum);
  EXPECT_NE(checksum_of({"mine", "mine.toml", "text", {{"a.py", "two"}}}), checksum);
  EXPECT_NE(checksum_of({"mine", "mine.toml", "text", {{"b.py", "one"}}}), checksum);
  EXPECT_NE(checksum_of({"mine", "mine.toml", "text", {}}), checksum);
}

}  // namespace
}  // namespace rehearse::experiment
