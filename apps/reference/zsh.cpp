#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/reference/pages.hpp"

namespace rehearse::apps {
namespace {

constexpr const char* kHelpers = R"sh(
_rehearse_priors() {
  local word
  local -a known
  for word in $words; do known+=($(_rehearse_priors_of $word)); done
  (( $#known )) || known=($(_rehearse_priors_of any))
  compset -P '*,'
  compadd -a known
}

_rehearse_keys() {
  local word
  local -a known
  for word in $words; do known+=($(_rehearse_keys_of $word)); done
  (( $#known )) || known=($(_rehearse_keys_of any))
  known+=($(_rehearse_keys_of runs))
  compset -P 1 '*=' || compadd -S = -a known
}
)sh";

/// Within [ ] or between colons of a specification.
std::string escaped(const std::string& text) {
  std::string all;
  for (const char c : text) {
    if (c == ':' || c == '[' || c == ']' || c == '\\') all += '\\';
    all += c;
  }
  return all;
}

std::string described(const std::vector<NamedThing>& things) {
  std::string text;
  for (const NamedThing& thing : things) text += " " + single_quoted(escaped(thing.name) + ":" + thing.summary);
  return text;
}

std::string list_function(const std::string& name, const std::vector<NamedThing>& things) {
  return fmt::format("\n_rehearse_{0}() {{\n  local -a names=({1})\n  _describe {0} names\n}}\n", name,
                     described(things));
}

const char* function(Names names) {
  switch (names) {
    case Names::scenarios:
      return "_rehearse_scenarios";
    case Names::learners:
      return "_rehearse_learners";
    case Names::presets:
      return "_rehearse_presets";
    case Names::priors:
      return "_rehearse_priors";
    case Names::keys:
      return "_rehearse_keys";
  }
  return "";
}

/// The completions as an action of _arguments.
std::string action(const Expected& expected) {
  std::vector<std::string> calls;
  for (const Names names : expected.names) calls.push_back(function(names));
  if (expected.folders) calls.push_back("_files -/");
  if (expected.files)
    calls.push_back(expected.ending.empty() ? "_files" : fmt::format("_files -g \"*{}\"", expected.ending));
  if (calls.empty()) return "( )";
  return calls.size() == 1 ? calls[0] : fmt::format("{{ {} }}", fmt::join(calls, "; "));
}

std::string specification(const ReferenceCommand& command, const ReferenceOption& option) {
  const std::string help = escaped(option.help);
  if (option.value.empty()) return single_quoted(option.name + "[" + help + "]");
  const std::string value = escaped(option.value) + ":" + action(expected(command.name, option));
  if (option.name == option.value) return single_quoted((option.repeated ? "*:" : ":") + value);
  return single_quoted((option.repeated ? "*" : "") + option.name + "=[" + help + "]:" + value);
}

std::string case_of(const ReferenceCommand& command) {
  std::string text = fmt::format("        {})\n          _arguments", command.name);
  for (const auto* options : {&command.options, &command.arguments})
    for (const ReferenceOption& option : *options) text += " \\\n            " + specification(command, option);
  return text + " ;;\n";
}

}  // namespace

std::string zsh_completion(const Reference& reference, const Vocabulary& words) {
  std::string text = "#compdef rehearse\n# Made from the definitions that read the command line.\n";
  text += kHelpers;
  text += list_function("scenarios", words.scenarios) + list_function("learners", words.learners) +
          list_function("presets", words.presets) + case_function("_rehearse_priors_of", words.priors) +
          case_function("_rehearse_keys_of", words.keys);
  std::vector<NamedThing> commands;
  std::string cases;
  for (const ReferenceCommand& command : reference.commands) {
    commands.push_back({command.name, command.summary});
    cases += case_of(command);
  }
  text += list_function("commands", commands);
  text += "\n_rehearse() {\n  local curcontext=$curcontext state line\n  typeset -A opt_args\n  _arguments -C";
  for (const ReferenceOption& option : reference.options) text += " " + specification({}, option);
  text +=
      " '1:command:_rehearse_commands' '*::argument:->arguments'\n  case $state in\n    arguments)\n      case "
      "$line[1] in\n";
  return text + cases + "      esac ;;\n  esac\n}\n\n_rehearse \"$@\"\n";
}

}  // namespace rehearse::apps
