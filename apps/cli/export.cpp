#include <array>

#include <fmt/format.h>

#include "apps/cli/arguments.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/complain.hpp"
#include "apps/cli/output_file.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/exported_policy.hpp"

namespace rehearse::apps {
namespace {

namespace fs = std::filesystem;

/// The format of an exported policy, by the ending of the file.
struct Format {
  const char* ending;
  std::string (*text)(const policy::Exported& exported, const fs::path& path);
};

constexpr std::array<Format, 3> kFormats = {{
    {".h", [](const policy::Exported& exported,
              const fs::path& path) { return policy::to_c(exported, policy::identifier(path.stem().string())); }},
    {".json", [](const policy::Exported& exported, const fs::path&) { return policy::to_json(exported); }},
    {".py", [](const policy::Exported& exported, const fs::path&) { return policy::to_numpy(exported); }},
}};

const Format& format_of(const fs::path& path, Violations& violations) {
  for (const Format& format : kFormats)
    if (path.extension() == format.ending) return format;
  violations.add(fmt::format("--out {}: must end in .h (C), .json or .py (NumPy)", path.string()));
  return kFormats.front();
}

}  // namespace

int export_policy(const experiment::Catalogue& catalogue, const ExportArguments& arguments) {
  const fs::path path = arguments.out;
  Violations violations;
  const Format& format = format_of(path, violations);
  const auto trial = trial_of(arguments.trial, violations);
  violations.throw_if_any();
  const policy::Exported exported =
      experiment::exported_policy(experiment::read_run(catalogue, arguments.folder), trial);
  const OutputFile file = policy_file(path, fmt::format("--out FILE{}", format.ending));
  const bool replaced = write_output(file, format.text(exported, path));
  const auto& earned = exported.origin.total_reward;
  put("{}{}: the policy of trial {}{}\n", path.string(), replaced ? ", which was there, is replaced" : "",
      exported.origin.trial, earned ? fmt::format(" (return {:.3f})", *earned) : ", which is to come");
  return kSuccess;
}

}  // namespace rehearse::apps
