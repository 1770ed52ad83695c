// A robot from logs alone.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/cli/arguments.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/complain.hpp"
#include "apps/cli/signals.hpp"
#include "apps/cli/status_line.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/experiment/study_setup.hpp"
#include "rehearse/files/new_folder.hpp"
#include "rehearse/files/write.hpp"
#include "rehearse/study/page.hpp"
#include "rehearse/study/study.hpp"
#include "rehearse/study/summary.hpp"
#include "rehearse/study/tables.hpp"

namespace rehearse::apps {
namespace {

namespace fs = std::filesystem;

std::string already_there(const std::string& path) {
  return fmt::format("{} exists already; --out DIR names another folder", path);
}

/// The folder is made and removed again. It is made for good when the study is done: a kill before that leaves nothing.
void check_out(const std::optional<std::string>& out, Violations& violations) {
  if (!out) return;
  std::error_code ignored;
  if (out->empty())
    violations.add("--out names no folder");
  else if (fs::exists(*out, ignored))
    violations.add(already_there(*out));
  else
    violations.attempt([&] { const files::NewFolder can_be_made(*out); });
}

void write(const std::string& out, const study::Study& study, const study::Problem& problem, const std::string& robot) {
  files::NewFolder folder(out);
  const char* const page = "identify.html";
  for (const auto& [name, text] : study::csv_files(study, problem)) files::write_file(folder.hidden() / name, text);
  files::write_file(folder.hidden() / page, study::page(study, problem, robot));
  if (!folder.appear()) throw InvalidInput(already_there(out));
  put("\n{} opens in a browser; tables are beside it\n", (fs::path(out) / page).string());
}

}  // namespace

int identify(const experiment::Catalogue& built_in, const IdentifyArguments& arguments) {
  Violations violations;
  const Index threads = threads_of(arguments.threads, violations);
  check_out(arguments.out, violations);
  const auto settings = settings_of(arguments.set, violations);
  experiment::Catalogue catalogue;
  if (!violations.attempt([&] { catalogue = with_robot(built_in, arguments.robot); })) violations.throw_if_any();
  const experiment::StudySetup setup =
      experiment::set_up_study(catalogue, {arguments.robot, arguments.prior, settings}, violations);
  experiment::ReadLogs read = experiment::read_logs(arguments.logs, arguments.held_out, setup, violations);
  const auto said = [](std::vector<experiment::ReadLog>& all) {
    std::vector<study::Log> logs;
    for (auto& [path, log, notes] : all) {
      for (const std::string& note : notes) put("{}: {}\n", path, note);
      logs.push_back(std::move(log));
    }
    return logs;
  };
  const std::vector<study::Log> logs = said(read.logs), held_out = said(read.held_out);
  violations.throw_if_any();
  const study::Problem problem = setup.problem(logs, held_out);
  StatusLine line;
  const auto evaluator = evaluator_until_signal(static_cast<int>(threads));
  try {
    const SignalWatch watch([] { return std::string("interrupted: nothing was written"); });
    const study::Study study = study::study_logs(
        problem, setup.options.study, *evaluator,
        [&](const Progress& progress) { line.show(fmt::format("learning from {} …", progress.phase)); });
    line.clear();
    for (const study::Section& section : study::summary(study, problem)) {
      put("\n{}\n", section.title);
      for (const std::string& text : study::lines_of(section)) put("  {}\n", text);
    }
    if (arguments.out) write(*arguments.out, study, problem, setup.scenario.name);
    return kSuccess;
  } catch (const Interrupted&) {
    line.clear();
    complain("interrupted: nothing was written");
    return exit_code_of_signal();
  }
}

}  // namespace rehearse::apps
