#pragma once
// Presets: options that go together, under a name or in a file; docs/presets.md describes it.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/experiment/spec.hpp"

namespace rehearse::experiment {

class Preset {
 public:
  /// source: the file's name, for messages. Throws InvalidInput with lines.
  Preset(std::string_view text, std::string source);

  const std::string& source() const { return source_; }
  const std::string& title() const { return title_; }

  /// Those for the runs of a learner on a scenario, in the order of the file: of two with one key the later counts.
  std::vector<FileOption> options(const std::string& scenario, const std::string& learner) const;

  /// "SOURCE: line N: …" for every name that the catalogue has not.
  std::vector<std::string> unknown_names(const Catalogue& catalogue) const;

 private:
  /// Options for some runs.
  struct Part {
    std::vector<std::string> scenarios, learners;  // empty: all
    std::vector<FileOption> options;
    Index line = 0;
  };

  std::string source_, title_;
  std::vector<Part> parts_;
};

/// NAME is one of the catalogue's, FILE.toml is read. Throws InvalidInput.
Preset find_preset(const Catalogue& catalogue, const std::string& name_or_file);

/// The one that applies to a scenario unasked, if any.
std::optional<Preset> default_preset(const Catalogue& catalogue, const std::string& scenario);

}  // namespace rehearse::experiment
