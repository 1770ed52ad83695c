#pragma once
// Typed arguments, converted to values; wrong ones become violations.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/experiment/catalogue.hpp"

namespace rehearse::apps {

/// Sets a field from --NAME.
void set_text(const Fields& fields, const std::string& name, const std::optional<std::string>& text,
              Violations& violations);

/// The number of --trial, from 1; none if it is not given.
std::optional<Index> trial_of(const std::optional<std::string>& text, Violations& violations);

/// A violation if --out, the name of a page, has the ending of something else.
void require_page(const std::optional<std::string>& out, Violations& violations);

/// Throws InvalidInput where no robot has this name, but there is a file NAME.toml.
void refuse_file_without_ending(const experiment::Catalogue& catalogue, const std::string& robot);

/// The catalogue with the robot of a file, NAME.toml; a built-in one is there already. Throws InvalidInput.
experiment::Catalogue with_robot(const experiment::Catalogue& built_in, const std::string& robot);

/// Key and value of each --set.
std::vector<std::pair<std::string, std::string>> settings_of(const std::vector<std::string>& set,
                                                             Violations& violations);

/// The number of --threads; 0, all cores, if it is not given.
Index threads_of(const std::optional<std::string>& text, Violations& violations);

}  // namespace rehearse::apps
