#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/reference/pages.hpp"

namespace rehearse::apps {
namespace {

constexpr const char* kHelpers = R"sh(
__rehearse_names() { # WORDS…: those that go on as the current word
  local found
  mapfile -t found < <(compgen -W "$*" -- "$cur")
  COMPREPLY+=("${found[@]}")
}

__rehearse_folders() {
  if declare -F _filedir >/dev/null; then _filedir -d; return; fi
  local found
  mapfile -t found < <(compgen -d -- "$cur")
  COMPREPLY+=("${found[@]}")
  compopt -o filenames 2>/dev/null
}

__rehearse_files() { # [ENDING]
  if declare -F _filedir >/dev/null; then _filedir ${1+"${1#.}"}; return; fi
  local found
  if [ $# -gt 0 ]; then mapfile -t found < <(compgen -d -- "$cur"; compgen -f -X "!*$1" -- "$cur")
  else mapfile -t found < <(compgen -f -- "$cur"); fi
  COMPREPLY+=("${found[@]}")
  compopt -o filenames 2>/dev/null
}

__rehearse_priors() {
  local word known= first=
  for word in "${COMP_WORDS[@]:2}"; do known+=" $(__rehearse_priors_of "$word")"; done
  [ -n "${known// /}" ] || known=$(__rehearse_priors_of any)
  [[ $cur != *,* ]] || first=${cur%,*},
  mapfile -t COMPREPLY < <(compgen -P "$first" -W "$known" -- "${cur##*,}")
}

__rehearse_keys() {
  local word known=$(__rehearse_keys_of runs) more=
  for word in "${COMP_WORDS[@]:2}"; do more+=" $(__rehearse_keys_of "$word")"; done
  [ -n "${more// /}" ] || more=$(__rehearse_keys_of any)
  mapfile -t COMPREPLY < <(compgen -S = -W "$known $more" -- "$cur")
  compopt -o nospace 2>/dev/null
}

# Which argument without a name the current word is, from 1. An = is a word of its own.
__rehearse_position() {
  local i word
  position=1
  for ((i = 2; i < COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    if [[ $word == --* ]]; then
      [[ " $with_value " == *" $word "* ]] || continue
      ((++i))
      [[ ${COMP_WORDS[i]} == = ]] && ((++i))
    elif [[ $word == = ]]; then
      ((++i))
    else
      ((++position))
    fi
  done
}
)sh";

constexpr const char* kBegin = R"sh(
_rehearse() {
  local cur=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
  local with_value= flags= position
  COMPREPLY=()
  if ((COMP_CWORD > 2)) && [[ $cur == = ]]; then
    cur=
  elif ((COMP_CWORD > 3)) && [[ $previous == = ]]; then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  if [[ ( ${COMP_WORDS[COMP_CWORD]} == = || ${COMP_WORDS[COMP_CWORD - 1]} == = ) && $previous != --* ]]; then return; fi
)sh";

std::string function(Names names, const Vocabulary& words) {
  switch (names) {
    case Names::scenarios:
      return "__rehearse_names " + names_of(words.scenarios);
    case Names::learners:
      return "__rehearse_names " + names_of(words.learners);
    case Names::presets:
      return "__rehearse_names " + names_of(words.presets);
    case Names::priors:
      return "__rehearse_priors";
    case Names::keys:
      return "__rehearse_keys";
  }
  return "";
}

/// Commands that complete a value.
std::string action(const Expected& expected, const Vocabulary& words) {
  std::vector<std::string> calls;
  for (const Names names : expected.names) calls.push_back(function(names, words));
  if (expected.folders) calls.push_back("__rehearse_folders");
  if (expected.files) calls.push_back("__rehearse_files" + (expected.ending.empty() ? "" : " " + expected.ending));
  return fmt::format("{}", fmt::join(calls, "; "));
}

std::string options_of(const ReferenceCommand& command, const Vocabulary& words) {
  std::string text = fmt::format("    {})\n      with_value=\"{}\" flags=\"{}\"\n      case $previous in\n",
                                 command.name, option_names(command, true), option_names(command, false));
  for (const ReferenceOption& option : command.options)
    if (const Expected values = expected(command.name, option); !values.nothing())
      text += fmt::format("        {}) {}; return ;;\n", option.name, action(values, words));
    else if (!option.value.empty())
      text += fmt::format("        {}) return ;;\n", option.name);
  return text + "      esac ;;\n";
}

std::string arguments_of(const ReferenceCommand& command, const Vocabulary& words) {
  std::string text;
  for (std::size_t i = 0; i < command.arguments.size(); ++i)
    text +=
        fmt::format("    \"{} \"{}) {} ;;\n", command.name, command.arguments[i].repeated ? "*" : std::to_string(i + 1),
                    action(expected(command.name, command.arguments[i]), words));
  return text;
}

}  // namespace

std::string bash_completion(const Reference& reference, const Vocabulary& words) {
  std::string text = "# Completion of bash for rehearse, made from the definitions that read the command line.\n";
  text += kHelpers;
  text += case_function("__rehearse_priors_of", words.priors) + case_function("__rehearse_keys_of", words.keys);
  text += kBegin;
  std::string commands, options, arguments;
  for (const ReferenceCommand& command : reference.commands) {
    commands += command.name + " ";
    options += options_of(command, words);
    arguments += arguments_of(command, words);
  }
  for (const ReferenceOption& option : reference.options) commands += option.name + " ";
  text += fmt::format("  if ((COMP_CWORD == 1)); then __rehearse_names {}; return; fi\n", commands);
  text += "  case $command in\n" + options + "  esac\n";
  text += "  if [[ $cur == -* ]]; then __rehearse_names $with_value $flags; return; fi\n  __rehearse_position\n";
  text += "  case \"$command $position\" in\n" + arguments + "  esac\n}\n\ncomplete -F _rehearse rehearse\n";
  return text;
}

}  // namespace rehearse::apps
