#include "rehearse/experiment/preset.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/preset_check.hpp"
#include "specs.hpp"

namespace rehearse::experiment {
namespace {

using specs::Options, specs::spec_of;

TEST(Preset, GivesItsOptionsWithTheirLinesInTheOrderOfTheFile) {
  const Preset preset("format = 1\n[set]\nb = 1\na = 2\n[[for]]\nscenarios = [\"line\"]\nset.b = 3\n", "x.toml");
  const auto lines = [&](const std::string& scenario) {
    std::vector<Index> lines;
    for (const FileOption& option : preset.options(scenario, "echo")) lines.push_back(option.line);
    return lines;
  };
  EXPECT_EQ(lines("line"), (std::vector<Index>{3, 4, 7}));
  EXPECT_EQ(lines("hexapod"), (std::vector<Index>{3, 4}));
  EXPECT_EQ(preset.options("line", "echo").back().text, "3");
}

TEST(Preset, IsAFileWhereItIsNamedSo) {
  const std::string file = testing::TempDir() + "rehearse_preset_test.toml";
  std::ofstream(file) << "format = 1\ntitle = \"mine\"\n[set]\nnoise = 0.25\n";
  EXPECT_EQ(find_preset(fake::catalogue(), file).title(), "mine");
  EXPECT_EQ(with_preset(fake::catalogue(), spec_of("echo"), file).options, (Options{{"noise", "0.25"}}));
  std::ofstream(file) << "format = 1\n[set]\nnoise = 0.25\n\nnosie = 1\n";
  EXPECT_EQ(fake::message_of<InvalidInput>([&] { with_preset(fake::catalogue(), spec_of("echo"), file); }),
            file + ": line 5: unknown option 'nosie', did you mean 'noise'? (learner echo on line)");
  std::remove(file.c_str());
}

}  // namespace
}  // namespace rehearse::experiment
