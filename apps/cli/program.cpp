#include "apps/cli/program.hpp"

#include <cerrno>

namespace rehearse::apps {

std::string program_name() { return ::program_invocation_short_name; }

}  // namespace rehearse::apps
