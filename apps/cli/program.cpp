#include "apps/cli/program.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <string_view>

namespace rehearse::apps {

std::string quoted(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return c >= 0x80 || std::isalnum(c) != 0 ||
           std::string_view("-_./,:=+@%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string program_name() { return ::program_invocation_short_name; }

std::string command_line(const std::vector<std::string>& words) {
  std::string line = program_name();
  for (const std::string& word : words) line += " " + quoted(word);
  return line;
}

}  // namespace rehearse::apps
