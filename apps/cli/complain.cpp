#include "apps/cli/complain.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "apps/cli/program.hpp"
#include "rehearse/core/text_table.hpp"

namespace rehearse::apps {

std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (byte == 0xc2 && 0x80 <= next && next < 0xa0)  // the control characters beyond ASCII, in UTF-8
      out += fmt::format("\\x{:02x}", next), ++i;
    else if (character_at(text, i) == 0 || (byte < 0x20 && byte != '\n') || byte == 0x7f)
      out += fmt::format("\\x{:02x}", byte);
    else
      out += text.substr(i, character_at(text, i)), i += character_at(text, i) - 1;
  }
  return out;
}

void put_error(const std::string& text) { (void)std::fputs(text.c_str(), stderr); }

void complain(std::string_view message) {
  const std::string safe = printable(message);
  for (std::string_view rest = safe; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    put_error(fmt::format("{}: {}\n", program_name(), rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

}  // namespace rehearse::apps
