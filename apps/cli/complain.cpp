#include "apps/cli/complain.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "apps/cli/program.hpp"

namespace rehearse::apps {

namespace {

/// The bytes of the character that a text of UTF-8 begins with; 0 if it is none.
std::size_t bytes_of_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(i < text.size() ? text[i] : 0); };
  const unsigned char first = byte(0);
  const std::size_t bytes = first < 0x80   ? 1
                            : first < 0xc2 ? 0
                            : first < 0xe0 ? 2
                            : first < 0xf0 ? 3
                            : first < 0xf5 ? 4
                                           : 0;
  for (std::size_t i = 1; i < bytes; ++i)
    if (byte(i) >> 6 != 2) return 0;
  return bytes;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto byte = static_cast<unsigned char>(text[0]);
    const auto next = static_cast<unsigned char>(text.size() > 1 ? text[1] : 0);
    std::size_t bytes = bytes_of_character(text);
    if (byte == 0xc2 && bytes == 2 && next < 0xa0)  // the control characters beyond ASCII
      out += fmt::format("\\x{:02x}", next);
    else if ((byte < 0x20 && byte != '\n') || byte == 0x7f || bytes == 0)
      out += fmt::format("\\x{:02x}", byte), bytes = 1;
    else
      out += text.substr(0, bytes);
    text.remove_prefix(bytes);
  }
  return out;
}

void complain(std::string_view message) {
  const std::string safe = printable(message);
  for (std::string_view rest = safe; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    fmt::print(stderr, "{}: {}\n", program_name(), rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

}  // namespace rehearse::apps
