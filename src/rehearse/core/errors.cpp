#include "rehearse/core/errors.hpp"

#include <string_view>

namespace rehearse {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

}  // namespace

InvalidInput::InvalidInput(const std::string& violation) : std::runtime_error(violation) {}
InvalidInput::InvalidInput(const std::vector<std::string>& violations) : std::runtime_error(joined(violations)) {}

std::vector<std::string> InvalidInput::violations() const {
  const std::string_view text = what();
  std::vector<std::string> lines;
  for (std::size_t begin = 0, end = 0; end != std::string_view::npos; begin = end + 1) {
    end = text.find('\n', begin);
    lines.emplace_back(text.substr(begin, end - begin));
  }
  return lines;
}

void Violations::add(const std::vector<std::string>& violations) {
  list_.insert(list_.end(), violations.begin(), violations.end());
}

void Violations::throw_if_any() const {
  if (!empty()) throw InvalidInput(list_);
}

}  // namespace rehearse
