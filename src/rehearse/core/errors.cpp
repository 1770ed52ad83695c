#include "rehearse/core/errors.hpp"

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

void Violations::throw_if_any() const {
  if (!empty()) throw InvalidInput(list_);
}

}  // namespace rehearse
