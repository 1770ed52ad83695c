#pragma once
// The words that shells complete.

#include <map>
#include <string>
#include <vector>

#include "apps/cli/reference.hpp"
#include "rehearse/experiment/catalogue.hpp"

namespace rehearse::apps {

struct NamedThing {
  std::string name, summary;
};

/// Words, by the name typed before them; those under "any" if there is none.
using WordsFor = std::map<std::string, std::vector<std::string>>;

/// Names of a build's catalogue.
struct Vocabulary {
  std::vector<NamedThing> scenarios, learners, presets;
  WordsFor priors;  // of each scenario
  WordsFor keys;    // what --set changes, but for experts' options, of each scenario and learner, and of "runs"
};

Vocabulary vocabulary(const experiment::Catalogue& catalogue);

/// Kinds of names. Priors and keys depend on the scenario and the learner that were typed before.
enum class Names { scenarios, learners, presets, priors, keys };

/// All completions of a value; none for numbers and other free text.
struct Expected {
  std::vector<Names> names;
  bool folders = false, files = false;
  std::string ending;  // of the files, ".toml"; empty: any

  bool nothing() const { return names.empty() && !folders && !files; }
};

/// Throws std::logic_error for an unknown kind of value, so that a new one is not forgotten here.
Expected expected(const std::string& command, const ReferenceOption& option);

/// The names of options that take a value, or of those that take none, separated by spaces.
std::string option_names(const ReferenceCommand& command, bool with_value);

std::string names_of(const std::vector<NamedThing>& things);

/// A function of bash and zsh that prints the words for a name.
std::string case_function(const std::string& function, const WordsFor& words);

/// The text within '…', for shells without escapes there.
std::string single_quoted(const std::string& text);

}  // namespace rehearse::apps
