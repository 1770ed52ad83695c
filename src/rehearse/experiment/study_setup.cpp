#include "rehearse/experiment/study_setup.hpp"

#include <filesystem>
#include <iterator>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "rehearse/experiment/priors.hpp"
#include "rehearse/experiment/told_file.hpp"
#include "rehearse/study/robot_alone.hpp"

namespace rehearse::experiment {
namespace {

bool set_one(const Fields& fields, const std::string& key, const std::string& text, Violations& violations) {
  try {
    return set_field(fields, key, text);
  } catch (const InvalidInput& error) {
    violations.add(error.what());
    return true;
  }
}

std::vector<std::string> known_keys(const Fields& a, const Fields& b) {
  std::vector<std::string> keys;
  for (const Fields* fields : {&a, &b})
    for (const auto& [name, value] : list_fields(*fields)) keys.push_back(name);
  return keys;
}

}  // namespace

StudySetup set_up_study(const Catalogue& catalogue, const StudyRequest& request, Violations& violations) {
  const std::string name = catalogue.scenario_name(request.robot);
  std::unique_ptr<scenario::ScenarioBuilder> builder;
  if (!violations.attempt([&] { builder = catalogue.scenario_or_throw(name); })) violations.throw_if_any();
  StudySetup setup;
  const Fields own = [&](FieldVisitor& v) { setup.options.fields(v); };
  const Fields of_robot = [&](FieldVisitor& v) { builder->fields(v); };
  std::vector<std::pair<std::string, std::string>> of_prior;
  for (const auto& [given, text] : request.settings) {
    constexpr std::string_view kScenario = "scenario.", kPrior = "prior.";
    const bool robots = given.starts_with(kScenario);  // as a run's spec writes the robot's options
    const std::string key = robots ? given.substr(kScenario.size()) : given;
    if (given.starts_with(kPrior))
      of_prior.emplace_back(given.substr(kPrior.size()), text);
    else if ((robots || !set_one(own, key, text, violations)) && !set_one(of_robot, key, text, violations))
      violations.add(unknown_option(key, known_keys(own, of_robot), "identify or the robot"));
  }
  if (!violations.attempt([&] { setup.scenario = builder->build(); })) violations.throw_if_any();
  std::vector<std::string> names = split_names(request.prior.value_or(""));
  if (names.empty() && !setup.scenario.priors.empty()) names = {setup.scenario.priors.front().name};
  violations.require(!names.empty(), fmt::format("{} has no prior, whose parameters could be identified", name));
  ChosenPriors priors(setup.scenario, names, violations);
  for (const auto& [key, text] : of_prior) priors.set(key, text, violations);
  violations.throw_if_any();
  setup.prior = priors.prior()->behind_actuators();
  setup.robot = study::robot_alone(setup.scenario.task);
  return setup;
}

namespace {

ReadLog read_log(const ToldFile& file, const StudySetup& setup) {
  const std::string path = file.path.string();
  const Task& task = setup.scenario.task;
  recording::Recording recording = recording::read_recording(file.bytes, path, task, setup.options.read);
  for (std::string& note : notes_on_ends(recording.episode, task)) recording.notes.push_back(std::move(note));
  const Actuators actuators = task.actuators();
  Matrix measured = setup.options.read.average ? std::move(recording.unaveraged)
                                               : recording.episode.states.leftCols(actuators.own_states());
  return {path,
          {file.path.stem().string(), study::robot_alone(std::move(recording.episode), actuators), std::move(measured)},
          std::move(recording.notes)};
}

void name_by_paths(std::vector<ReadLog>& logs) {
  std::map<std::string, int> times;
  for (const ReadLog& read : logs) ++times[read.log.name];
  for (ReadLog& read : logs)
    if (times[read.log.name] > 1) read.log.name = read.path;
}

}  // namespace

ReadLogs read_logs(const std::vector<std::string>& logs, const std::vector<std::string>& held_out,
                   const StudySetup& setup, Violations& violations) {
  std::vector<std::filesystem::path> paths(logs.begin(), logs.end());
  paths.insert(paths.end(), held_out.begin(), held_out.end());
  std::vector<ReadLog> all;
  for (const ToldFile& file : read_told_files(paths, violations, setup.options.read))
    violations.attempt([&] { all.push_back(read_log(file, setup)); });
  name_by_paths(all);
  if (!violations.empty()) return {std::move(all), {}};
  const auto middle = std::make_move_iterator(all.begin() + static_cast<std::ptrdiff_t>(logs.size()));
  return {{std::make_move_iterator(all.begin()), middle}, {middle, std::make_move_iterator(all.end())}};
}

}  // namespace rehearse::experiment
