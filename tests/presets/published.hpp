#pragma once
// Text for files, made from the published values of the options of all learners and scenarios.

#include <string>
#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/experiment/catalogue.hpp"

namespace rehearse::presets {

/// An option that several learners, or scenarios, have with the same default and the same published value.
struct PublishedOption {
  std::string key, by_default;
  Published published;
  bool of_scenarios = false;
  std::vector<std::string> of;  // names

  bool deviates() const { return by_default != published.text; }
};

/// In the order of the catalogue and of the fields.
std::vector<PublishedOption> published_options(const experiment::Catalogue& catalogue);

/// The part of presets/as-published.toml that is made from them.
std::string preset_text(const std::vector<PublishedOption>& options);

/// A row of the table in docs/architecture.md.
struct Deviation {
  std::string option, of, by_default, published;  // cells
  std::string why;                                // written by hand

  std::string text() const;
};

/// Those that deviate, without a word on why.
std::vector<Deviation> deviations(const std::vector<PublishedOption>& options);

/// The rows of the table that begins with its head in a page. Throws std::runtime_error if there is none.
std::vector<Deviation> read_table(const std::string& page);

/// The page with these rows instead.
std::string with_table(const std::string& page, const std::vector<Deviation>& rows);

}  // namespace rehearse::presets
