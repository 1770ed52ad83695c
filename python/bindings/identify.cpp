#include "python/bindings/identify.hpp"

#include <pybind11/stl.h>

#include "python/bindings/work.hpp"
#include "rehearse/experiment/participants.hpp"
#include "rehearse/experiment/study_setup.hpp"
#include "rehearse/study/page.hpp"
#include "rehearse/study/summary.hpp"
#include "rehearse/study/tables.hpp"

namespace rehearse::python {
namespace {

using Strings = std::vector<std::string>;

/// Files of logs: those that are learned from, and those that are forecast.
struct Files {
  Strings logs, held_out;
};

struct Texts {
  std::vector<std::pair<std::string, std::string>> tables;  // name and CSV
  std::vector<std::pair<std::string, Strings>> summary;     // title and lines
  Strings notes;
  std::string page;
};

std::vector<study::Log> with_notes(std::vector<experiment::ReadLog>& read, Strings& notes) {
  std::vector<study::Log> logs;
  for (auto& [path, log, its_notes] : read) {
    for (const std::string& note : its_notes) notes.push_back(log.name + ": " + note);
    logs.push_back(std::move(log));
  }
  return logs;
}

Texts identify(const Robot& robot, const experiment::StudyRequest& request, const Files& files,
               const Settings& settings) {
  Texts texts;
  work_with(robot, settings, [&](const Robot& own, const experiment::RunOptions& options) {
    Violations violations;
    const experiment::StudySetup setup = experiment::set_up_study(own.catalogue(), request, violations);
    experiment::ReadLogs read = experiment::read_logs(files.logs, files.held_out, setup, violations);
    violations.throw_if_any();
    const auto logs = with_notes(read.logs, texts.notes), held_out = with_notes(read.held_out, texts.notes);
    const study::Problem problem = setup.problem(logs, held_out);
    const study::Study study = study::study_logs(problem, setup.options.study, *experiment::evaluator_of(options));
    texts.tables = study::csv_files(study, problem);
    for (const study::Section& section : study::summary(study, problem))
      texts.summary.emplace_back(section.title, study::lines_of(section));
    texts.page = study::page(study, problem, setup.scenario.name);
  });
  return texts;
}

}  // namespace

void add_identify(py::module_& module) {
  using namespace py::literals;
  module.def(
      "identify",
      [](const Robot& robot, const std::string& scenario, const std::optional<std::string>& prior,
         const std::vector<std::pair<std::string, std::string>>& options, const Strings& logs, const Strings& held_out,
         int threads) {
        const Texts texts = identify(robot, {scenario, prior, options}, {logs, held_out}, {threads});
        return py::dict("tables"_a = texts.tables, "summary"_a = texts.summary, "notes"_a = texts.notes,
                        "page"_a = texts.page);
      },
      "robot"_a, "scenario"_a, "prior"_a, "options"_a, "logs"_a, "held_out"_a, "threads"_a);
}

}  // namespace rehearse::python
