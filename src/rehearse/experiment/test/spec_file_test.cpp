#include "rehearse/experiment/spec_file.hpp"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

#include "specs.hpp"

namespace rehearse::experiment {
namespace {

using specs::complaint, specs::Options, specs::spec_of;

TEST(SpecFile, ComesBackAsItWas) {
  for (const std::string prior : {"near", "near,far", "oracle"}) {
    const Spec spec = resolve(fake::catalogue(), spec_of("echo", prior, {{"noise", "1e-05"}})).spec;
    const Spec back = from_toml(to_toml(spec), "spec.toml");
    EXPECT_EQ(fingerprint(back), fingerprint(spec));
    EXPECT_EQ(to_toml(resolve(fake::catalogue(), back).spec), to_toml(spec));
  }
}

TEST(SpecFile, OfARunThatIsToldSaysSoInPlaceOfWhatItSaid) {
  const std::string text = to_toml(spec_of("echo", "near")), told = of_told_run(text);
  EXPECT_TRUE(told.starts_with("# A run of Rehearse that is told of its robot: "));
  EXPECT_EQ(told.substr(told.find('\n')), text.substr(text.find('\n')));
  EXPECT_EQ(of_told_run(told), told);
  const std::string without = text.substr(text.find('\n') + 1);
  EXPECT_EQ(of_told_run(without), without) << "somebody took the line out";
}

TEST(SpecFile, SaysBehindEachOptionWhatItDoes) {
  const Resolved resolved = resolve(fake::catalogue(), spec_of("echo", "near", {{"told_by", "measured"}}));
  const std::string text = to_toml(resolved.spec, resolved.comments);
  for (const char* line :
       {"\nseed = 1                                        # seed of all random numbers: the same "
        "one gives the same run\n",
        "\nnoise = 0.01                                    # standard deviation of the measurement noise [m]\n",
        "\ntold_by = \"measured\"                            # states that rewards and success are"})
    EXPECT_NE(text.find(line), std::string::npos) << line << " in " << text;
  std::istringstream lines(text.substr(text.find("[scenario]")));
  for (std::string line; std::getline(lines, line);)
    EXPECT_EQ(line.find(" = ") == std::string::npos, line.find("  # ") == std::string::npos) << line;
  const Spec back = from_toml(text, "spec.toml");
  EXPECT_EQ(back.options, resolved.spec.options);
  EXPECT_EQ(fingerprint(back), fingerprint(resolved.spec));
  const Spec odd{.scenario = "line", .learner = "echo", .options = {{"learner.a", "x # y"}}};
  EXPECT_EQ(from_toml(to_toml(odd, {{"learner.a", "two\nlines = 1"}}), "").options, odd.options);
}

TEST(SpecFile, SaysByWhatLearnersAreToldWhereThatIsNotTheTruth) {
  const Spec plain = resolve(fake::catalogue(), spec_of("echo", "near")).spec;
  EXPECT_EQ(to_toml(plain).find("told_by"), std::string::npos);
  const Spec spec = resolve(fake::catalogue(), spec_of("echo", "near", {{"told_by", "measured"}})).spec;
  EXPECT_EQ(spec.told_by, ToldBy::measured);
  EXPECT_EQ(spec.options, plain.options);
  EXPECT_NE(fingerprint(spec), fingerprint(plain));
  EXPECT_EQ(from_toml(to_toml(spec), "spec.toml").told_by, ToldBy::measured);
  EXPECT_EQ(complaint(spec_of("echo", "near", {{"told_by", "rumour"}})),
            "told_by = rumour, must be one of truth, measured");
}

TEST(SpecFile, KeepsTextThatLooksLikeSomethingElse) {
  const Options options = {{"learner.a", "-0"},   {"learner.b", "inf"},          {"learner.c", "1e+20"},
                           {"learner.d", "true"}, {"learner.e.f", "say \"no\""}, {"learner.odd key@b", "1_000"},
                           {"learner.g", "0x10"}, {"learner.h", "0.1"},          {"learner.i", ""}};
  const Spec back = from_toml(to_toml({.scenario = "line", .learner = "echo", .options = options}), "spec.toml");
  for (const auto& option : options)
    EXPECT_NE(std::find(back.options.begin(), back.options.end(), option), back.options.end()) << option.first;
  EXPECT_EQ(back.options.size(), options.size());
}

TEST(SpecFile, AKeyThatBeginsAnotherIsQuotedWhole) {
  const Options options = {{"scenario.plant.lag_s", "1"},
                           {"scenario.plant.lag_s.f", "2"},
                           {"scenario.plant.mass", "3"},
                           {"learner.a.b.c", "4"},
                           {"learner.a", "5"},
                           {"learner.a.d e", "6"},
                           {"prior.leg", "7"},
                           {"prior.leg.mass", "8"},
                           {"prior.legs.mass", "9"},
                           {"prior.plant.lag_s.f", "10"}};
  const Spec spec{.scenario = "line", .learner = "echo", .options = options};
  const std::string text = to_toml(spec);
  EXPECT_EQ(text.substr(text.find("\n[scenario]")),
            "\n[scenario]\n\"plant.lag_s\" = 1\n\"plant.lag_s.f\" = 2\nplant.mass = 3\n"
            "\n[learner]\n\"a.b.c\" = 4\n\"a\" = 5\n\"a.d e\" = 6\n"
            "\n[prior]\n\"leg\" = 7\n\"leg.mass\" = 8\nlegs.mass = 9\nplant.lag_s.f = 10\n");
  const Spec back = from_toml(text, "spec.toml");
  EXPECT_EQ(back.options, options);
  EXPECT_EQ(fingerprint(back), fingerprint(spec));
  EXPECT_NO_THROW(require_readable(spec, text));
}

TEST(SpecFile, WhatWouldNotComeBackIsNamed) {
  const auto complaint_about = [](const Spec& spec) {
    return fake::message_of<InvalidInput>([&] { require_readable(spec, to_toml(spec)); });
  };
  const std::string begin = "a run of this spec could not be opened again: its spec.toml would ";
  EXPECT_EQ(complaint_about({.scenario = "line", .learner = "echo", .options = {{"gain", "2"}, {"learner.a", "1"}}}),
            begin + "lack gain = 2");
  EXPECT_TRUE(complaint_about({.scenario = "line", .learner = "echo", .options = {{"learner.a\x7f", "1"}}})
                  .starts_with(begin + "not be read: line "));
  const Spec spec{.scenario = "line", .learner = "echo"};
  EXPECT_EQ(fake::message_of<InvalidInput>([&] { require_readable(spec, to_toml({.scenario = "cart"})); }),
            begin + "be that of another one");
}

TEST(SpecFile, SaysWhereItIsWrong) {
  const auto complaint_about = [](const std::string& text) {
    return fake::message_of<InvalidInput>([&] { from_toml(text, "x.toml"); });
  };
  EXPECT_TRUE(complaint_about("format = 1\n[run\n").starts_with("x.toml: line 2: "));
  EXPECT_EQ(complaint_about("a = 1\n"), "x.toml: not a spec: it needs `format` and [run]");
  EXPECT_EQ(complaint_about("format = 7\n[run]\n"),
            "x.toml: format 7 is that of another version of Rehearse, this one reads 1");
  EXPECT_EQ(
      complaint_about("format = 1\n[run]\ntrails = 3\nseed = -1\n[learner]\nx = [1]\n[lerner]\n"),
      "x.toml: line 3: unknown key 'trails' in [run], did you mean 'trials'? (known: scenario, robot, learner, prior, "
      "trials, until_solved, seed, start, told_by)\n"
      "x.toml: line 4: seed = -1, must be between 0 and 9007199254740992\n"
      "x.toml: line 6: learner.x: a value must be a number, true, false or text\n"
      "x.toml: line 7: unknown key 'lerner', did you mean 'learner'? (known: format, run, scenario, learner, prior)");
}

TEST(SpecFile, LocatesWhatResolvingItFinds) {
  const auto complaints_about = [](const std::string& text, const std::string& set = "") {
    const SpecFile file(text, "x.toml");
    Spec spec = file.spec();
    if (!set.empty()) spec.options.emplace_back(set, "-1");
    std::vector<std::string> complaints;
    try {
      resolve(fake::catalogue(), spec);
    } catch (const InvalidInput& error) {
      for (const std::string& line : error.violations()) complaints.push_back(file.located(fake::catalogue(), line));
    }
    return complaints;
  };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(complaints_about("format = 1\n[run]\nscenario = \"line\"\nlearner = \"eco\"\n"),
            Lines{"x.toml: line 4: unknown learner 'eco', did you mean 'echo'? (known: echo, echo-alone)"});
  EXPECT_EQ(complaints_about("format = 1\n[run]\nscenario = \"line\"\nlearner = \"echo\"\nprior = \"nera\"\n"),
            Lines{"x.toml: line 5: unknown prior 'nera' of scenario line, did you mean 'near'? (known: near, far, "
                  "oracle)"});
  EXPECT_EQ(complaints_about("format = 1\n[run]\nscenario = \"line\"\n"),
            Lines{"x.toml: line 2: no learner is named (known: echo, echo-alone)"});
  const std::string options =
      "format = 1\n[run]\nscenario = \"line\"\nlearner = \"echo\"\n[scenario]\nnosie = 0\n[learner]\n"
      "search.step = \"fast\"\nserch.step = 1\n[prior]\ngain = 9\n";
  EXPECT_EQ(complaints_about(options, "noise"),
            (Lines{"x.toml: line 6: unknown option 'scenario.nosie', did you mean 'scenario.noise'?",
                   "x.toml: line 8: search.step = fast, must be a number",
                   "x.toml: line 9: unknown option 'learner.serch.step', did you mean 'learner.search.step'?",
                   "noise = -1, must be ≥ 0", "x.toml: line 11: prior near: gain = 9, must be between 0.1 and 4"}));
}

}  // namespace
}  // namespace rehearse::experiment
