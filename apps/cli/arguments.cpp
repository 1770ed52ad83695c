#include "apps/cli/arguments.hpp"

#include <fmt/format.h>

namespace rehearse::apps {

void set_text(const Fields& fields, const std::string& name, const std::optional<std::string>& text,
              Violations& violations) {
  if (!text) return;
  try {
    set_field(fields, name, *text);
  } catch (const InvalidInput& error) {
    violations.add(fmt::format("--{}", error.what()));
  }
}

Index threads_of(const std::optional<std::string>& text, Violations& violations) {
  Index threads = 0;
  set_text([&](FieldVisitor& v) { v.integer("threads", threads, "threads to compute with", between(1, 1024)); },
           "threads", text, violations);
  return threads;
}

}  // namespace rehearse::apps
