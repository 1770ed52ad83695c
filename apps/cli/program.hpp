#pragma once

#include <string>

namespace rehearse::apps {

/// The name by which this program was called: "rehearse", or that of a program with robots of its own. Messages name
/// it, because it alone can resume its runs.
std::string program_name();

}  // namespace rehearse::apps
