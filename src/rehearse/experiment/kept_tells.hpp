#pragma once
// FOLDER/told/001, … keep a run as it was before each `tell`, and the files that were told: so that the last tell can
// be taken back. Each of these folders appears in one step.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rehearse/experiment/record.hpp"
#include "rehearse/experiment/run_folder.hpp"
#include "rehearse/experiment/told_file.hpp"

namespace rehearse::experiment {

struct KeptTell {
  std::filesystem::path folder;
  History before;
  std::vector<std::filesystem::path> files;  // copies

  /// The trial that was told; empty: the files are logs.
  std::optional<Index> trial() const { return before.asked ? std::optional(before.asked->trial) : std::nullopt; }
};

/// Keeps the run and the files; call it before the run changes. A tell that a kill interrupted gives way.
void keep_tell(const RunFolder& run, const std::vector<ToldFile>& files);

/// The last one. Throws InvalidInput if there is none, or the run went on without being told.
KeptTell last_tell(const RunFolder& run);

/// Forgets the last tell that was kept, because it did not come about.
void forget_tell(const RunFolder& run);

/// Copies its files to FOLDER/taken-back, under their names behind checksums. Returns where they are.
std::vector<std::filesystem::path> set_aside(const RunFolder& run, const KeptTell& tell);

/// Makes the files that decide how the run goes on those from before it, and removes those of trials that are no more.
void restore(const RunFolder& run, const KeptTell& tell);

}  // namespace rehearse::experiment
