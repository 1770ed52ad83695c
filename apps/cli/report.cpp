#include "rehearse/report/report.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "apps/cli/arguments.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/complain.hpp"
#include "apps/cli/output_file.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/qd/archive_bytes.hpp"

namespace rehearse::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPage = "report.html";
constexpr std::string_view kPageBegins = "<!doctype html>";

/// A program of one's own is told where Rehearse was installed, and has its own build folder.
[[noreturn]] void refuse_without_page(const fs::path& program, const std::string& share) {
  const bool in_build = share.empty() && fs::exists(program / "CMakeCache.txt");
  const std::string command =
      fmt::format("cmake {0} && cmake --build {0} --target page", in_build ? program.string() : "BUILD_FOLDER");
  const std::string install = share.empty() ? "" : fmt::format(" && cmake --install BUILD_FOLDER, into {}", share);
  throw InvalidInput(
      fmt::format("the page of reports is not built; with nodejs and npm installed: {}{}", command, install));
}

/// The page without data, in the build folder or where `cmake --install` put it.
std::string page_template(const std::string& share) {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& folder : {program / "share/rehearse", program.parent_path() / "share/rehearse", fs::path(share)})
    if (fs::exists(folder / kPage)) return files::read_file(folder / kPage, files::Links::follow);
  refuse_without_page(program, share);
}

int write_page(const fs::path& folder, const report::Report& report, const std::string& share, const fs::path& out) {
  const std::string page = to_html(report, page_template(share));
  write_output({.path = out,
                .kind = "page of Rehearse",
                .option = "--out FILE.html",
                .is_ours = [](std::string_view text) { return text.starts_with(kPageBegins); }},
               page);
  for (const report::Problem& problem : report.problems)
    complain(fmt::format("{}: {}", (folder / problem.where).string(), problem.what));
  fmt::print("{} ({:.1f} MB) opens in a browser\n", printable(out.string()), 1e-6 * static_cast<double>(page.size()));
  return kSuccess;
}

report::ArchiveSpace archive_space(std::string_view bytes) {
  const qd::Archive archive = qd::from_bytes(bytes, "it is no usable archive").archive;
  const qd::Niches& niches = archive.niches();
  return {archive.size(), niches.size(), niches.bounds(), niches.bins()};
}

}  // namespace

int report(const ReportArguments& arguments, const std::string& share) {
  const fs::path folder = arguments.folder;
  return write_page(folder, report::read_folder(folder, archive_space), share,
                    arguments.out.value_or((folder / "report.html").string()));
}

int replay(const ReplayArguments& arguments, const std::string& share) {
  const fs::path folder = arguments.folder;
  const Index trial = *trial_of(arguments.trial);
  const fs::path beside = folder / fmt::format("replay-{:03}.html", trial);
  return write_page(folder, report::read_trial(folder, trial), share, arguments.out.value_or(beside.string()));
}

}  // namespace rehearse::apps
