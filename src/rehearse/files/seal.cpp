#include "rehearse/files/seal.hpp"

#include <charconv>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/files/checksum.hpp"

namespace rehearse::files {
namespace {

constexpr int kFormat = 1;

std::string header(std::string_view kind, std::string_view body) {
  return fmt::format("rehearse-{} {} {} {:016x}\n", kind, kFormat, body.size(), checksum(body));
}

}  // namespace

std::string seal(std::string_view kind, std::string_view body) { return header(kind, body).append(body); }

std::string_view unseal(std::string_view kind, std::string_view bytes) {
  const std::size_t line = bytes.find('\n');
  const std::string start = fmt::format("rehearse-{} ", kind);
  int format = 0;
  if (line == std::string_view::npos || !bytes.starts_with(start) ||
      std::from_chars(bytes.data() + start.size(), bytes.data() + line, format).ec != std::errc())
    throw InvalidInput(fmt::format("the {} is truncated or not one of Rehearse", kind));
  if (format != kFormat)
    throw InvalidInput(
        fmt::format("the {} has format {}, of another version of Rehearse (this one reads {})", kind, format, kFormat));
  const std::string_view body = bytes.substr(line + 1);
  if (bytes.substr(0, line + 1) != header(kind, body))
    throw InvalidInput(fmt::format("the {} is truncated or damaged", kind));
  return body;
}

}  // namespace rehearse::files
