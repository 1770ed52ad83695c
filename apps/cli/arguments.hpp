#pragma once
// Arguments as they were typed, read as what they mean; what is wrong becomes violations.

#include <optional>
#include <string>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/options.hpp"

namespace rehearse::apps {

/// Sets a field from --NAME.
void set_text(const Fields& fields, const std::string& name, const std::optional<std::string>& text,
              Violations& violations);

/// Of --threads; 0, all cores, if it is not given.
Index threads_of(const std::optional<std::string>& text, Violations& violations);

}  // namespace rehearse::apps
