#pragma once
// Text files generated from the definitions of the command line and the catalogue.

#include <string>

#include "apps/reference/words.hpp"

namespace rehearse::apps {

/// Manual pages in roff: of the program, and of one command. date: of the release, "2026-11-26".
std::string man_page(const Reference& reference, const std::string& date);
std::string man_page(const Reference& reference, const ReferenceCommand& command, const std::string& date);

/// docs/command-line.md.
std::string markdown_page(const Reference& reference);

/// docs/robot-file.md. schema: of robots' files, JSON.
std::string robot_page(const std::string& schema);

/// Completions for shells.
std::string bash_completion(const Reference& reference, const Vocabulary& words);
std::string zsh_completion(const Reference& reference, const Vocabulary& words);
std::string fish_completion(const Reference& reference, const Vocabulary& words);

/// "rehearse tell DIR FILE.csv… [OPTIONS]", without the program.
std::string synopsis(const ReferenceCommand& command);

}  // namespace rehearse::apps
