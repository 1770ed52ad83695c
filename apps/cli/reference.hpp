#pragma once
// The command line as it describes itself, for manual pages, shells and docs/command-line.md: from the definitions that
// parse what is typed.

#include <string>
#include <vector>

namespace rehearse::apps {

struct ReferenceOption {
  std::string name;   // "--out"; "DIR", an argument without a name
  std::string value;  // "FILE.html"; empty: a flag
  std::string help;
  bool required = false;
  bool repeated = false;  // several values may follow
};

struct ReferenceCommand {
  std::string name, summary, examples;
  std::vector<ReferenceOption> arguments, options;
};

struct Reference {
  std::string about, examples, version;
  std::vector<ReferenceOption> options;  // of the program without a command
  std::vector<ReferenceCommand> commands;
};

Reference reference();

}  // namespace rehearse::apps
