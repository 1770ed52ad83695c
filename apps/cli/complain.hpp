#pragma once

#include <string>
#include <string_view>

namespace rehearse::apps {

/// Text of others for a terminal: every control character but the ends of lines as \\x1b.
std::string printable(std::string_view text);

/// One line on standard error for each line of the message, printable.
void complain(std::string_view message);

}  // namespace rehearse::apps
