#include "apps/cli/parse_errors.hpp"

#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "rehearse/core/options.hpp"

namespace rehearse::apps {
namespace {

/// A line for each option that is given more often than it has values.
std::string repeated_options(const CLI::App& app) {
  std::string lines;
  for (const CLI::App* command : app.get_subcommands())
    for (const CLI::Option* option : command->get_options())
      if (option->get_items_expected_max() == 1 && option->count() > 1 &&
          option->get_multi_option_policy() == CLI::MultiOptionPolicy::Throw)
        lines += fmt::format("{}{} is given {} times, must be once", lines.empty() ? "" : "\n", option->get_name(),
                             option->count());
  return lines;
}

/// A line for each unknown flag, with the most similar one.
std::string unknown_flags(const CLI::App& app) {
  std::string lines;
  for (const CLI::App* command : app.get_subcommands()) {
    std::vector<std::string> known;
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (const std::string& given : command->remaining()) {
      if (!given.starts_with("--")) continue;
      const std::string flag = given.substr(0, given.find('='));
      lines += fmt::format("{}unknown flag '{}' of {}{}", lines.empty() ? "" : "\n", flag, command->get_name(),
                           suggestions(flag, known));
    }
  }
  return lines;
}

}  // namespace

std::string why_not_parsed(const CLI::App& app, const CLI::ParseError& error) {
  for (std::string lines : {repeated_options(app), unknown_flags(app)})
    if (!lines.empty()) return lines;
  const std::string why = error.what(), flag = why.substr(0, why.find(' '));
  if (why == CLI::ArgumentMismatch::FlagOverride(flag).what()) return fmt::format("--{} takes no value", flag);
  return why;
}

}  // namespace rehearse::apps
