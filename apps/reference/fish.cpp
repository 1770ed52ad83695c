#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/reference/pages.hpp"

namespace rehearse::apps {
namespace {

constexpr const char* kHelpers = R"sh(
function __rehearse_has_no_command
    test (count (commandline -opc)) -eq 1
end

function __rehearse_has_command
    set -l words (commandline -opc)
    test (count $words) -gt 1; and contains -- $words[2] $argv
end

function __rehearse_words_for -a table
    set -l found
    for word in (commandline -opc)
        set -a found ($table $word)
    end
    test (count $found) -gt 0; or set found ($table any)
    printf '%s\n' $found
end

function __rehearse_priors
    __rehearse_words_for __rehearse_priors_of
end

function __rehearse_keys
    for key in (__rehearse_words_for __rehearse_keys_of) (__rehearse_keys_of runs)
        echo $key=
    end
end
)sh";

/// Within single quotes, which have two escapes.
std::string quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') all += '\\';
    all += c;
  }
  return all + "'";
}

std::string list_function(const std::string& name, const std::vector<NamedThing>& things) {
  std::string text = fmt::format("\nfunction __rehearse_{}\n", name);
  for (const NamedThing& thing : things) text += fmt::format("    echo {}\\t{}\n", thing.name, quoted(thing.summary));
  return text + "end\n";
}

std::string table(const std::string& function, const WordsFor& words) {
  std::string text = "\nfunction " + function + "\n    switch $argv[1]\n";
  for (const auto& [name, those] : words)
    text += fmt::format("        case {}\n            printf '%s\\n' {}\n", name, fmt::join(those, " "));
  return text + "    end\nend\n";
}

const char* function(Names names) {
  switch (names) {
    case Names::scenarios:
      return "(__rehearse_scenarios)";
    case Names::learners:
      return "(__rehearse_learners)";
    case Names::presets:
      return "(__rehearse_presets)";
    case Names::priors:
      return "(__rehearse_priors)";
    case Names::keys:
      return "(__rehearse_keys)";
  }
  return "";
}

/// The words for `complete -a`; empty for free text and for files of any ending, which need none.
std::string action(const Expected& expected) {
  std::vector<std::string> calls;
  for (const Names names : expected.names) calls.push_back(function(names));
  if (expected.folders) calls.push_back("(__fish_complete_directories (commandline -ct))");
  if (expected.files && !expected.ending.empty())
    calls.push_back(fmt::format("(__fish_complete_suffix {})", expected.ending));
  return fmt::format("{}", fmt::join(calls, " "));
}

std::string line_of(const ReferenceCommand& command, const ReferenceOption& option) {
  const bool argument = option.name == option.value;
  const Expected values = expected(command.name, option);
  const bool any_file = values.files && values.ending.empty();
  std::string text = fmt::format("complete -c rehearse -n '__rehearse_has_command {}'", command.name);
  if (!argument) text += fmt::format(" -l {}", option.name.substr(2));
  if (!argument && !option.value.empty()) text += any_file ? " -r -F" : " -x";
  if (argument && any_file) text += " -F";
  if (const std::string words = action(values); !words.empty()) text += " -a " + quoted(words);
  return text + (argument ? "" : " -d " + quoted(option.help)) + "\n";
}

}  // namespace

std::string fish_completion(const Reference& reference, const Vocabulary& words) {
  std::string text = "# Completion of fish for rehearse, made from the definitions that read the command line.\n";
  text += kHelpers;
  text += list_function("scenarios", words.scenarios) + list_function("learners", words.learners) +
          list_function("presets", words.presets) + table("__rehearse_priors_of", words.priors) +
          table("__rehearse_keys_of", words.keys) + "\ncomplete -c rehearse -f\n";
  for (const ReferenceOption& option : reference.options)
    text += fmt::format("complete -c rehearse -n __rehearse_has_no_command -l {} -d {}\n", option.name.substr(2),
                        quoted(option.help));
  for (const ReferenceCommand& command : reference.commands) {
    text += fmt::format("complete -c rehearse -n __rehearse_has_no_command -a {} -d {}\n", command.name,
                        quoted(command.summary));
    for (const auto* options : {&command.arguments, &command.options})
      for (const ReferenceOption& option : *options) text += line_of(command, option);
  }
  return text;
}

}  // namespace rehearse::apps
