#include "rehearse/report/report.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/report/campaign_files.hpp"
#include "rehearse/report/files.hpp"
#include "rehearse/report/run_files.hpp"

namespace rehearse::report {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPlaceForData = "REHEARSE_REPORT_DATA";

bool has(const fs::path& folder, const char* file) { return fs::exists(folder / file); }

std::string name_of(const fs::path& folder) {
  const fs::path whole = fs::weakly_canonical(folder);
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

/// `read` fills the entry `kind`; what it throws is about `file`.
template <class Read>
Report make_report(const fs::path& folder, const char* kind, const char* file, Read read,
                   const std::string& headline = "") {
  Problems problems;
  Json json = {{"format", 1}, {"name", headline.empty() ? name_of(folder) : headline}};
  if (!headline.empty()) json["headline"] = headline;
  try {
    json[kind] = read(problems);
  } catch (const InvalidInput& error) {
    std::vector<std::string> lines = error.violations();
    for (std::string& line : lines) line = fmt::format("{}: {}", (folder / file).string(), line);
    throw InvalidInput(lines);
  }
  json["problems"] = Json::array();
  for (const auto& [where, what] : problems.list()) json["problems"].push_back({{"where", where}, {"what", what}});
  return {json.dump(-1, ' ', false, Json::error_handler_t::replace), problems.list()};
}

void require_folder(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InvalidInput(fmt::format("{} is not a folder", folder.string()));
}

Report read_run_folder(const fs::path& folder, const Knowledge& knowledge) {
  return make_report(folder, "run", "spec.toml",
                     [&](Problems& problems) { return read_run(folder, {}, knowledge, problems); });
}

}  // namespace

Report read_folder(const fs::path& folder, const Knowledge& knowledge) {
  require_folder(folder);
  if (has(folder, "spec.toml")) return read_run_folder(folder, knowledge);
  if (has(folder, "summary.json"))
    return make_report(folder, "campaign", "summary.json",
                       [&](Problems& problems) { return read_campaign(folder, problems); });
  if (has(folder, "campaign.toml"))
    throw InvalidInput(fmt::format("{} is a campaign without results yet: it has no summary.json", folder.string()));
  if (has(folder, "identify.html"))
    throw InvalidInput(
        fmt::format("{} is of `identify`; its page is {}", folder.string(), (folder / "identify.html").string()));
  throw InvalidInput(
      fmt::format("{} is neither a run folder (no spec.toml) nor a campaign (no summary.json)", folder.string()));
}

Report read_trial(const fs::path& folder, Index trial, const std::string& headline) {
  require_folder(folder);
  if (!has(folder, "spec.toml"))
    throw InvalidInput(fmt::format("{} is not a run folder: it has no spec.toml", folder.string()));
  const fs::path trajectory = folder / "trajectories" / fmt::format("trial-{:03}.csv", trial);
  if (!fs::exists(trajectory))
    throw InvalidInput(
        fmt::format("trial {} is not in {}: there is no {}", trial, folder.string(), trajectory.string()));
  return make_report(
      folder, "replay", "spec.toml", [&](Problems& problems) { return read_run(folder, trial, {}, problems); },
      headline);
}

std::string to_html(const Report& report, std::string_view page_template) {
  const std::size_t place = page_template.find(kPlaceForData);
  if (place == std::string_view::npos || page_template.find(kPlaceForData, place + 1) != std::string_view::npos)
    throw InvalidInput("the report's page is damaged: it must have one place for the data");
  std::string page(page_template.substr(0, place));
  for (char c : report.json)  // so that no text in the data can end the element that holds it
    c == '<' ? page += "\\u003c" : page += c;
  return page += page_template.substr(place + kPlaceForData.size());
}

}  // namespace rehearse::report
