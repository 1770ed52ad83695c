#pragma once

#include <string>
#include <vector>

namespace rehearse::apps {

/// The name by which this program was called: "rehearse", or that of a program with robots of its own. Messages name
/// it, because it alone can resume its runs.
std::string program_name();

/// A word as one types it in a shell: 'my run'.
std::string quoted(const std::string& word);

/// A command of this program as one types it in a shell: "rehearse ask 'my run'".
std::string command_line(const std::vector<std::string>& words);

}  // namespace rehearse::apps
