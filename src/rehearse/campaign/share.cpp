#include "rehearse/campaign/share.hpp"

#include <charconv>
#include <string_view>

namespace rehearse::campaign {
namespace {

std::optional<Index> whole(std::string_view text) {
  Index number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return number;
}

}  // namespace

std::optional<Share> read_share(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return {};
  const auto number = whole(std::string_view(text).substr(0, slash));
  const auto of = whole(std::string_view(text).substr(slash + 1));
  if (!number || !of || *number < 1 || *number > *of) return {};
  return Share{*number, *of};
}

}  // namespace rehearse::campaign
