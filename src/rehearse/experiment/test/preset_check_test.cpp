#include "rehearse/experiment/preset_check.hpp"

#include <gtest/gtest.h>

#include "presets.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "specs.hpp"

namespace rehearse::experiment {
namespace {

using presets::with;
using specs::Options, specs::spec_of;

Options options_of(const std::string& text, const Spec& spec) {
  return with_preset(with(text), spec, "careful").options;
}

std::string preset_complaint(const std::string& text, const std::string& name = "careful") {
  return fake::message_of<InvalidInput>([&] { with_preset(with(text), spec_of("echo"), name); });
}

TEST(PresetCheck, GivesEachRunTheOptionsThatAreForIt) {
  const std::string text =
      "[set]\nnoise = 0.5\n"
      "[[for]]\nlearners = [\"echo\"]\nset.search.step = 0.1\n"
      "[[for]]\nscenarios = [\"line\"]\nlearners = [\"echo\", \"echo-alone\"]\nset.search.step = 0.2\n"
      "[[for]]\nscenarios = [\"hexapod\"]\nset.search.step = 0.3\n";
  EXPECT_EQ(options_of(text, spec_of("echo")),
            (Options{{"noise", "0.5"}, {"search.step", "0.1"}, {"search.step", "0.2"}}));
  EXPECT_EQ(options_of(text, spec_of("echo-alone")), (Options{{"noise", "0.5"}, {"search.step", "0.2"}}));
}

TEST(PresetCheck, ComesAfterDefaultsAndBeforeWhatIsAskedForLater) {
  Catalogue catalogue = with("[set]\nsearch.step = 0.2\nprior.gain = 3\n");
  catalogue.default_presets = {{"line", "format = 1\n[set]\nsearch.step = 0.1\nnoise = 3\n"}};
  Spec spec = with_preset(catalogue, spec_of("echo", "", {{"noise", "1"}}), "careful");
  Spec complete = resolve(catalogue, spec).spec;
  EXPECT_EQ(complete.options[1], (std::pair<std::string, std::string>{"scenario.noise", "1"}));
  EXPECT_EQ(complete.options[4], (std::pair<std::string, std::string>{"learner.search.step", "0.2"}));
  EXPECT_EQ(complete.options[5], (std::pair<std::string, std::string>{"prior.gain", "3"}));
  spec.options.emplace_back("search.step", "0.4");
  EXPECT_EQ(resolve(catalogue, spec).spec.options[4],
            (std::pair<std::string, std::string>{"learner.search.step", "0.4"}));
}

TEST(PresetCheck, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(
      preset_complaint("", "carefull"),
      "unknown preset 'carefull', did you mean 'careful'? (known: careful, bold); a file is named with its .toml");
  EXPECT_EQ(fake::message_of<InvalidInput>([] { find_preset(fake::catalogue(), "bold"); }),
            "unknown preset 'bold': there are none; a file is named with its .toml");
  EXPECT_EQ(preset_complaint(""), "presets/careful.toml: nothing is set for learner echo on scenario line");
  EXPECT_EQ(
      preset_complaint("[set]\nnoise = -1\nsearch.stp = 1\n[[for]]\nlearners = [\"eco\"]\n"),
      "presets/careful.toml: line 5: unknown learner 'eco', did you mean 'echo'? (known: echo, echo-alone)\n"
      "presets/careful.toml: line 3: noise = -1, must be ≥ 0 (learner echo on line)\n"
      "presets/careful.toml: line 4: unknown option 'search.stp', did you mean 'search.step'? (learner echo on line)");
  EXPECT_EQ(preset_complaint("colour = 1\nfor = 3\n[set]\nnoise = [1, 2]\n"),
            "presets/careful.toml: line 2: unknown key 'colour' (known: format, title, set, for)\n"
            "presets/careful.toml: line 3: parts for some runs are written as [[for]]\n"
            "presets/careful.toml: line 5: noise: a value must be a number, true, false or text");
  EXPECT_EQ(fake::message_of<InvalidInput>([] { Preset("[set]\n", "x.toml"); }),
            "x.toml: a preset begins with format = 1");
}

/// An option that is wrong without the preset is not its fault.
TEST(PresetCheck, IsNotBlamedForOthers) {
  EXPECT_EQ(with_preset(with("[set]\nnoise = 1\n"), spec_of("echo", "", {{"colour", "red"}}), "careful").options.size(),
            2u);
}

}  // namespace
}  // namespace rehearse::experiment
