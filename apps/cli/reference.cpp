#include "apps/cli/reference.hpp"

#include <CLI/CLI.hpp>

#include "apps/cli/help.hpp"
#include "apps/cli/parser.hpp"
#include "apps/cli/program.hpp"

namespace rehearse::apps {
namespace {

ReferenceOption option_reference(const CLI::Option& option) {
  const bool takes_value = option.get_items_expected_max() > 0;
  ReferenceOption described{option.get_name(), "", option.get_description(), option.get_required(),
                            option.get_items_expected_max() > 1};
  if (option.get_positional())
    described.value = described.name;
  else if (takes_value)
    described.value = option.get_type_name();
  if (!option.get_lnames().empty()) described.name = "--" + option.get_lnames().front();
  return described;
}

std::vector<ReferenceOption> option_references(const CLI::App& command, bool arguments) {
  std::vector<ReferenceOption> all;
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional() == arguments) all.push_back(option_reference(*option));
  return all;
}

}  // namespace

Reference reference() {
  CLI::App app(kAbout, program_name());
  Typed typed;
  define(app, typed);
  Reference all{kAbout, app.get_footer(), REHEARSE_VERSION, option_references(app, false), {}};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    all.commands.push_back({command->get_name(), command->get_description(), command->get_footer(),
                            option_references(*command, true), option_references(*command, false)});
  return all;
}

}  // namespace rehearse::apps
