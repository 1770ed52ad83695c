#pragma once

#include <optional>
#include <string>

#include "apps/cli/commands.hpp"

namespace CLI {
class App;
}

namespace rehearse::apps {

/// The command that was typed, with its arguments.
struct Typed {
  std::string command;
  ListArguments list;
  NewArguments make_new;
  CheckArguments check;
  LearnArguments learn;
  ResumeArguments resume;
  AskArguments ask;
  TellArguments tell;
  StatusArguments status;
  CampaignArguments campaign;
  IdentifyArguments identify;
  ReportArguments report;
  ReplayArguments replay;
  ExportArguments export_policy;
  EvaluateArguments evaluate;
};

/// Tells the parser of all commands and options. Both arguments live as long as it is used.
void define(CLI::App& app, Typed& typed);

/// Throws InvalidInput. Empty: help or the version was asked for, and is printed unless `silent`.
std::optional<Typed> parse(int argc, char** argv, bool silent);

}  // namespace rehearse::apps
