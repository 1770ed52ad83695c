#include "rehearse/campaign/folder.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "rehearse/campaign/planner.hpp"
#include "rehearse/campaign/summary.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/spec_file.hpp"
#include "rehearse/files/new_folder.hpp"
#include "rehearse/files/seal.hpp"

namespace rehearse::campaign {
namespace {

namespace fs = std::filesystem;

constexpr const char *kFile = "campaign.toml", *kRuns = "runs";
constexpr std::chrono::seconds kUntilVisible{30};  // network file systems may show an old state for a while

/// True if a folder is empty; remains of a start that was killed do not count.
bool is_blank(const fs::path& folder) {
  return std::all_of(fs::directory_iterator(folder), fs::directory_iterator(), [](const fs::directory_entry& entry) {
    return entry.path().filename() == "lock" || entry.path().extension() == ".tmp";
  });
}

void make_folder(const fs::path& path) {
  try {
    if (!fs::exists(path)) fs::create_directories(path);
    if (!fs::is_directory(path)) throw InvalidInput(fmt::format("{} is not a folder", path.string()));
    if (!is_blank(path) && !fs::exists(path / kFile))  // in this order: another share may begin it meanwhile
      throw InvalidInput(
          fmt::format("{} already exists and is not the folder of a campaign; name another", path.string()));
  } catch (const fs::filesystem_error& error) {
    throw InvalidInput(fmt::format("cannot create {}: {}", path.string(), error.code().message()));
  }
}

/// The plan with which a folder was begun.
CampaignPlan begun_plan(const experiment::Catalogue& catalogue, const fs::path& file, const std::string& text) {
  try {
    return plan_campaign(catalogue, text, file.string());
  } catch (const InvalidInput& error) {
    throw InvalidInput(
        fmt::format("{}\nthe campaign in this folder cannot be read; name another folder", error.what()));
  }
}

/// Throws InvalidInput unless every run that was begun is one of the plan, with as many trials or more.
void check_only_adds(const CampaignPlan& begun, const CampaignPlan& plan, const fs::path& path) {
  std::map<std::string, std::uint64_t> wanted;
  for (const PlannedRun& run : plan.runs) wanted[run.name] = experiment::fingerprint(run.spec);
  std::vector<std::string> lacking, changed;
  for (const PlannedRun& run : begun.runs) {
    const auto found = wanted.find(run.name);
    if (found == wanted.end())
      lacking.push_back(run.name);
    else if (found->second != experiment::fingerprint(run.spec))
      changed.push_back(run.name);
  }
  Violations violations;
  const auto others = [](const std::vector<std::string>& names) {
    if (names.size() == 1) return names.front();
    return fmt::format("{} and {} other run{}", names.front(), names.size() - 1, names.size() == 2 ? "" : "s");
  };
  if (!lacking.empty())
    violations.add(fmt::format("{} was begun with {}, which the campaign file no longer has; name another folder",
                               path.string(), others(lacking)));
  if (!changed.empty())
    violations.add(
        fmt::format("{} was begun with other options of {}; name another folder", path.string(), others(changed)));
  violations.require(plan.trials >= begun.trials,
                     fmt::format("{} was begun with {} trials, the campaign file has {}; name another folder",
                                 path.string(), begun.trials, plan.trials));
  violations.throw_if_any();
}

std::set<std::string> names_of_runs(const CampaignPlan& plan) {
  std::set<std::string> names;
  for (const PlannedRun& run : plan.runs) names.insert(run.name);
  return names;
}

/// The options in the plan's order; those that an older version did not have are as planned, which are its defaults:
/// the campaign's file is the same.
void complete(experiment::Spec& spec, const experiment::Spec& planned) {
  auto rest = std::move(spec.options);
  spec.options = planned.options;
  for (auto& [key, value] : spec.options) {
    const auto own = std::ranges::find(rest, key, [](const auto& option) { return option.first; });
    if (own == rest.end()) continue;
    value = own->second;
    rest.erase(own);
  }
  spec.options.insert(spec.options.end(), rest.begin(), rest.end());
}

/// The spec of a run's folder. Throws InvalidInput unless it is that of a run of the plan, but for its trials.
experiment::Spec spec_of(const fs::path& file, const PlannedRun& run) {
  experiment::Spec spec = experiment::from_toml(files::read_file(file), file.string());
  complete(spec, run.spec);
  if (experiment::fingerprint(spec) != experiment::fingerprint(run.spec))
    throw InvalidInput(fmt::format("{} has other options: it is of another campaign or version", file.string()));
  return spec;
}

/// True if a run's spec is of this robot as another file described it.
bool has_another_robot(const fs::path& file, const PlannedRun& run) {
  try {
    if (!fs::exists(file)) return false;
    const experiment::Spec spec = experiment::from_toml(files::read_file(file), file.string());
    return spec.scenario == run.spec.scenario && spec.robot != run.spec.robot;
  } catch (const std::runtime_error&) {  // damaged: this run alone fails
    return false;
  }
}

/// Throws InvalidInput if a run was begun with another robot: that campaign cannot go on, and must stay as it is.
void check_same_robot(const fs::path& path, const CampaignPlan& plan) {
  for (const PlannedRun& run : plan.runs)
    if (has_another_robot(path / kRuns / run.name / "spec.toml", run))
      throw InvalidInput(
          fmt::format("{} was begun with another robot {}: its file, or one that it names, has changed since; name "
                      "another folder",
                      path.string(), plan.scenario));
}

/// Writes the campaign's file and folders for `plan`, in a folder that is locked.
void begin(const experiment::Catalogue& catalogue, const fs::path& path, std::string_view text,
           const CampaignPlan& plan, files::FolderLock::Kind kind) {
  const fs::path file = path / kFile;
  const std::string begun = fs::exists(file) ? files::read_file(file) : "";
  if (!begun.empty() && begun != text) check_only_adds(begun_plan(catalogue, file, begun), plan, path);
  check_same_robot(path, plan);
  try {
    if (kind == files::FolderLock::Kind::exclusive) files::remove_temporaries(file);
    if (begun != text) files::write_shared_file(file, text);
    fs::create_directories(path / kRuns);
  } catch (const fs::filesystem_error& error) {
    throw InvalidInput(fmt::format("cannot write in {}: {}", path.string(), error.code().message()));
  }
}

/// The rows of a trials.csv; none if the file is missing or damaged: the run is resumed, and writes it again from its
/// checkpoint.
RunOutcome rows_of(const fs::path& file, Index trials) {
  try {
    if (fs::exists(file)) return outcome_of(files::read_csv(files::read_file(file)), trials);
  } catch (const InvalidInput&) {
  }
  return {};
}

}  // namespace

void CampaignFolder::remove_abandoned(const CampaignPlan& plan) const {
  const std::set<std::string> names = names_of_runs(plan);
  std::vector<fs::path> abandoned;
  for (const auto& entry : fs::directory_iterator(path_ / kRuns)) {
    const auto name = files::name_of_hidden(entry.path().filename().string());
    if (name && names.contains(*name)) abandoned.push_back(entry.path());
  }
  for (const fs::path& path : abandoned) fs::remove_all(path);
}

CampaignFolder CampaignFolder::open(const experiment::Catalogue& catalogue, const fs::path& given,
                                    std::string_view text, const CampaignPlan& plan, files::FolderLock::Kind kind) {
  const fs::path path = files::without_slash(given);
  make_folder(path);
  files::FolderLock lock(path, kind);
  begin(catalogue, path, text, plan, kind);
  return {path, std::move(lock)};
}

CampaignFolder CampaignFolder::join(const fs::path& given, std::string_view text) {
  const fs::path path = files::without_slash(given), file = path / kFile;
  const auto until = std::chrono::steady_clock::now() + kUntilVisible;
  while (!files::holds(file, text)) {
    if (std::chrono::steady_clock::now() > until)
      throw InvalidInput(
          fmt::format("this process does not see what rank 0 wrote to {}; the folder must be on a file system that all "
                      "machines share",
                      file.string()));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return {path, std::nullopt};
}

namespace {

/// Throws InvalidInput where the folder is another's or damaged.
RunOutcome contents_of(const fs::path& folder, const PlannedRun& run) {
  if (!fs::exists(fs::symlink_status(folder))) return {};
  const experiment::Spec spec = spec_of(folder / "spec.toml", run);
  RunOutcome outcome = rows_of(folder / "trials.csv", run.spec.trials);
  if (const auto solved_at = outcome.first_success(outcome.done()); solved_at && run.spec.until_solved)
    outcome = rows_of(folder / "trials.csv", *solved_at);  // what came after it was by hand
  const bool solved = !outcome.solved.empty() && outcome.solved.back().value_or(false);
  const bool extended =  // by hand; if its end was not reached, ours was
      spec.trials > run.spec.trials || (run.spec.until_solved && !spec.until_solved);
  if (!run.spec.ends_with(outcome.done(), solved) || !(extended || fs::exists(folder / "done"))) return outcome;
  files::unseal("checkpoint", files::read_file(folder / "checkpoint"));
  outcome.state = RunState::done;
  return outcome;
}

}  // namespace

RunOutcome CampaignFolder::read(const PlannedRun& run) const {
  RunOutcome outcome;
  try {
    return contents_of(path_of(run), run);
  } catch (const InvalidInput& error) {
    outcome.fail(error.what());
  } catch (const fs::filesystem_error& error) {
    outcome.fail(fmt::format("cannot read {}: {}", error.path1().string(), error.code().message()));
  }
  outcome.unusable = true;
  return outcome;
}

std::vector<Skipped> CampaignFolder::strangers(const CampaignPlan& plan) const {
  const std::set<std::string> names = names_of_runs(plan);
  std::vector<Skipped> found;
  for (const auto& entry : fs::directory_iterator(path_ / kRuns)) {
    const std::string name = entry.path().filename().string();
    if (!names.contains(name)) found.push_back({fmt::format("{}/{}", kRuns, name), "not a run of this campaign"});
  }
  std::sort(found.begin(), found.end(), [](const Skipped& a, const Skipped& b) { return a.path < b.path; });
  return found;
}

void CampaignFolder::write(const Campaign& campaign) const {
  files::write_file(path_ / "campaign.csv", campaign_csv(campaign));
  files::write_file(path_ / "summary.json", summary_json(campaign));
}

}  // namespace rehearse::campaign
