#pragma once
// spec.toml: a spec as a file that can be read, kept, and run again.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "rehearse/experiment/catalogue.hpp"
#include "rehearse/experiment/spec.hpp"

namespace rehearse::experiment {

/// The spec as TOML, with a comment behind each option that has one.
std::string to_toml(const Spec& spec, const Comments& comments = {});

/// Such a text whose first line says that the file alone does not give the run: its episodes, or logs, were told. A
/// first line that is another stays.
std::string of_told_run(std::string toml);

/// A spec read from a file, with the line of each key.
class SpecFile {
 public:
  /// Throws InvalidInput with the source's name and line.
  SpecFile(std::string_view text, const std::string& source);

  const Spec& spec() const { return spec_; }

  /// "SOURCE: line N: VIOLATION", where the file is to blame, alone, for what `resolve` says of a spec made from it;
  /// else the violation as it is.
  std::string located(const Catalogue& catalogue, const std::string& violation) const;

 private:
  Index line_of_names(const std::string& violation) const;

  std::string source_;
  Spec spec_, bare_;  // with the options and without
  std::vector<FileOption> options_;
  std::map<std::string, Index> run_lines_;  // of [run] ("") and its keys
};

/// The spec alone; throws as SpecFile does.
Spec from_toml(std::string_view text, const std::string& source_name);

/// Throws InvalidInput, with the options that would differ, if the text of a spec.toml does not give the spec back.
void require_readable(const Spec& spec, const std::string& text);

/// A checksum of everything in the spec but its end, which may change during a run.
std::uint64_t fingerprint(const Spec& spec);

}  // namespace rehearse::experiment
