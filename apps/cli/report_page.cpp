#include "apps/cli/report_page.hpp"

#include <vector>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/kept_robot.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/qd/archive_bytes.hpp"
#include "rehearse/report/report.hpp"

namespace rehearse::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPage = "report.html";

/// Throws with the commands that build the page. A program of one's own has another build folder, and `share`.
[[noreturn]] void refuse_without_page(const fs::path& program, const std::string& share) {
  const bool in_build = share.empty() && fs::exists(program / "CMakeCache.txt");
  const std::string command =
      fmt::format("cmake {0} && cmake --build {0} --target page", in_build ? program.string() : "BUILD_FOLDER");
  const std::string install = share.empty() ? "" : fmt::format(" && cmake --install BUILD_FOLDER, into {}", share);
  throw InvalidInput(
      fmt::format("the page of reports is not built; with nodejs and npm installed: {}{}", command, install));
}

/// The page without data: in `share`; else in the build folder or where `cmake --install` put it. The order matters,
/// since the program may be Python, beside which another installation has its page.
std::string page_template(const std::string& share) {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
  std::vector<fs::path> folders{program / "share/rehearse", program.parent_path() / "share/rehearse"};
  if (!share.empty()) folders.insert(folders.begin(), share);
  for (const fs::path& folder : folders)
    if (fs::exists(folder / kPage)) return files::read_file(folder / kPage, files::Links::follow);
  refuse_without_page(program, share);
}

report::ArchiveSpace archive_space(std::string_view bytes) {
  const qd::Archive archive = qd::from_bytes(bytes, "it is no usable archive").archive;
  const qd::Niches& niches = archive.niches();
  return {archive.size(), niches.size(), niches.bounds(), niches.bins()};
}

report::RobotFacts facts_of(const experiment::Catalogue& built_in, const fs::path& folder,
                            const std::string& scenario) try {
  const auto robot = experiment::with_robot_of_run(built_in, folder).scenario(scenario);
  if (!robot) return {};
  report::RobotFacts facts{.task = robot->summary(), .units = {}};
  for (const scenario::NamedPrior& prior : robot->build().priors)
    for (const Parameter& parameter : prior.parameters.all())
      if (!parameter.unit.empty()) facts.units[parameter.name] = parameter.unit;
  return facts;
} catch (const InvalidInput&) {
  return {};
}

Page filled(const report::Report& report, const std::string& share) {
  return {to_html(report, page_template(share)), report.problems};
}

}  // namespace

void require_page_template(const std::string& share) { page_template(share); }

Page report_page(const experiment::Catalogue& built_in, const fs::path& folder, const std::string& share) {
  const auto robot = [&](const std::string& scenario) { return facts_of(built_in, folder, scenario); };
  return filled(report::read_folder(folder, {archive_space, robot}), share);
}

Page replay_page(const fs::path& folder, Index trial, const std::string& share, const std::string& headline) {
  return filled(report::read_trial(folder, trial, headline), share);
}

}  // namespace rehearse::apps
