#include <fmt/format.h>

#include "apps/reference/pages.hpp"

namespace rehearse::apps {
namespace {

constexpr const char* kIntroduction = R"(# The command line

This page has every argument of every command.

`rehearse COMMAND --help` says the same of one command, and so does `man rehearse-COMMAND` where a package is
[installed](install.md). Shells complete commands, options, names and files. Options for `--set` are on
[a page of their own](options.md).

Made by `scripts/published` from the definitions that read the command line.

| command | what it does |
|---|---|
)";

std::string cell_of(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, 1, '\\');
  return text;
}

std::string row_of(const ReferenceOption& option) {
  const std::string value = option.name == option.value || option.value.empty() ? "" : " " + option.value;
  return fmt::format("| `{}{}` | {} |\n", option.name, value, cell_of(option.help));
}

std::string section_of(const ReferenceCommand& command) {
  std::string text =
      fmt::format("\n## {}\n\n{}.\n\n```text\nrehearse {}\n```\n", command.name, command.summary, synopsis(command));
  std::string rows;
  for (const ReferenceOption& option : command.arguments) rows += row_of(option);
  for (const ReferenceOption& option : command.options)
    if (option.name != "--help") rows += row_of(option);
  if (!rows.empty()) text += "\n| argument | what it does |\n|---|---|\n" + rows;
  if (!command.examples.empty()) text += "\n```text\n" + command.examples + "\n```\n";
  return text;
}

}  // namespace

std::string synopsis(const ReferenceCommand& command) {
  std::string text = command.name;
  for (const ReferenceOption& argument : command.arguments) {
    const std::string word = argument.name + (argument.repeated ? "…" : "");
    text += argument.required ? " " + word : " [" + word + "]";
  }
  bool optional = false;
  for (const ReferenceOption& option : command.options) {
    if (option.required) text += " " + option.name + " " + option.value;
    optional |= !option.required && option.name != "--help";
  }
  return text + (optional ? " [OPTIONS]" : "");
}

std::string markdown_page(const Reference& reference) {
  std::string text = kIntroduction;
  for (const ReferenceCommand& command : reference.commands)
    text += fmt::format("| [`{0}`](#{0}) | {1} |\n", command.name, cell_of(command.summary));
  text +=
      "\nEvery command takes `--help`; `rehearse --version` shows the version. Exit codes: 0 for success, 1 where "
      "something failed, 2 for\nwrong input, 128 + the signal where one stopped it.\n";
  for (const ReferenceCommand& command : reference.commands) text += section_of(command);
  return text;
}

}  // namespace rehearse::apps
