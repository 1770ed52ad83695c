#include <filesystem>

#include <fmt/format.h>

#include "apps/cli/arguments.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/complain.hpp"
#include "apps/cli/output_file.hpp"
#include "apps/cli/report_page.hpp"

namespace rehearse::apps {
namespace {

namespace fs = std::filesystem;

int write_page(const fs::path& folder, const Page& page, const fs::path& out) {
  write_output(page_file(out, "--out FILE.html"), page.html);
  for (const report::Problem& problem : page.problems)
    complain(fmt::format("{}: {}", (folder / problem.where).string(), problem.what));
  put("{} ({:.1f} MB) opens in a browser\n", out.string(), 1e-6 * static_cast<double>(page.html.size()));
  return kSuccess;
}

}  // namespace

int report(const experiment::Catalogue& catalogue, const ReportArguments& arguments, const std::string& share) {
  const fs::path folder = arguments.folder;
  Violations violations;
  require_page(arguments.out, violations);
  violations.throw_if_any();
  return write_page(folder, report_page(catalogue, folder, share),
                    arguments.out.value_or((folder / "report.html").string()));
}

int replay(const ReplayArguments& arguments, const std::string& share) {
  const fs::path folder = arguments.folder;
  Violations violations;
  const Index trial = *trial_of(arguments.trial, violations);
  require_page(arguments.out, violations);
  violations.throw_if_any();
  const fs::path beside = folder / fmt::format("replay-{:03}.html", trial);
  return write_page(folder, replay_page(folder, trial, share, arguments.headline),
                    arguments.out.value_or(beside.string()));
}

}  // namespace rehearse::apps
