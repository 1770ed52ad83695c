#include "rehearse/robot_file/read_dynamics.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "rehearse/core/names.hpp"
#include "rehearse/robot_file/kept_files.hpp"
#include "rehearse/robot_file/read_model.hpp"
#include "rehearse/robot_file/variant.hpp"

namespace rehearse::robot_file {
namespace {

/// True if an argument of a command looks like a file: script.py, ./simulator. robot.local does not.
bool looks_like_a_file(const std::string& argument, bool first) {
  constexpr std::string_view kFiles[] = {".py",  ".js",  ".mjs", ".sh",   ".rb",   ".jl",   ".lua",
                                         ".pl",  ".r",   ".m",   ".jar",  ".toml", ".json", ".yaml",
                                         ".yml", ".csv", ".xml", ".urdf", ".txt"};
  const std::filesystem::path path(argument);
  const bool named = std::ranges::count(kFiles, path.extension().string()) > 0;
  return !argument.starts_with('-') && path.is_relative() && (named || (first && path.has_parent_path()));
}

/// True if a name has letters (of any alphabet: Python's keywords have), digits, - and _. Options are named after
/// parameters, and a dot would make one the beginning of another; formulas know fewer names.
bool is_name_of_parameter(const std::string& name) {
  std::string ascii = name;
  std::erase_if(ascii, [](unsigned char c) { return c >= 0x80; });
  return !name.empty() && (ascii.empty() || is_word(ascii));
}

class DynamicsReader {
 public:
  DynamicsReader(Robot& robot, const scenario::ReadFile& read_file, files::FileViolations& violations)
      : robot_(robot), kept_(robot.files, read_file), violations_(violations) {}

  void read(const std::string& name, const toml::table& part) {
    Table table(part, fmt::format("[dynamics.{}]", name), violations_);
    Dynamics dynamics{.name = name, .line = files::line_of(part)};
    read_parameters(table, dynamics);
    read_source(table, dynamics);
    if (const auto* model = std::get_if<ModelSource>(&dynamics.source))
      dynamics.lines = lines_of_model(part, *model, robot_.action_names());
    table.finish();
    robot_.dynamics.push_back(std::move(dynamics));
  }

 private:
  void read_source(Table& table, Dynamics& dynamics) {
    std::vector<std::string> command;
    std::string model, function;
    refuse_several_sources(table);
    if (table.reader().take("function", function)) {
      require_function(robot_.functions, robot_.functions.dynamics, function, dynamics.line, violations_);
      dynamics.source = FunctionSource{function};
    } else if (table.reader().take_words("program", command)) {
      dynamics.source = read_program(table, std::move(command));
    } else if (table.reader().take("model", model)) {
      dynamics.source = read_model(table, model);
    } else {
      dynamics.source = read_equations(table, dynamics.line);
    }
  }

  void refuse_several_sources(Table& table) {
    std::vector<std::string> given;
    for (const std::string key : {"function", "program", "model", "rate"})
      if (table.reader().has(key)) given.push_back(key);
    if (given.size() < 2) return;
    for (const std::string& key : given) table.reader().take(key);
    table.reader().take("define");  // what equations may have, too
    table.wrong(given.back(), fmt::format("a dynamics has {}, must have one of them", fmt::join(given, " and ")));
  }

  ModelSource read_model(Table& table, const std::string& path) {
    kept_.require(table, "model", path);
    kept_.take_files(table);
    ModelSource model = model_of(table, robot_, violations_);
    model.path = path;
    model.parameters = std::move(moved_);
    return model;
  }

  void read_parameters(Table& table, Dynamics& dynamics) {
    moved_.clear();
    const bool is_model = table.reader().has("model");
    const toml::table* values = table.reader().take_table("parameters");
    if (!values) return;
    for (const auto& [name, node] : in_order(*values)) {
      double value = 0;
      std::string unit;
      if (!is_name_of_parameter(name))
        violations_.add(files::line_of(*node),
                        fmt::format("the name of parameter '{}' must be of letters, digits, - and _", name));
      if (const toml::table* with_unit = node->as_table()) {
        Table entry(*with_unit, name, violations_);
        if (!entry.number("value", value)) entry.wrong("value", fmt::format("parameter {} needs a value", name));
        entry.unit(unit);
        if (is_model) moved_.push_back(moved_by(entry, {.name = name, .unit = unit, .value = value}, violations_));
        entry.finish();
      } else if (is_model) {
        violations_.add(files::line_of(*node), fmt::format("parameter {} must say what it sets or scales", name));
      } else {
        take_number(name, *node, value, violations_);
      }
      dynamics.parameters.push_back(Parameter::fixed(name, value, unit));
    }
  }

  Equations read_equations(Table& table, Index line) {
    Equations equations{.definitions = table.definitions("define")};
    const Definitions given = table.definitions("rate");
    const std::vector<std::string> states = robot_.state_names();
    for (const auto& [name, formula] : given)
      if (!is_among(name, states))
        violations_.add(formula.line,
                        fmt::format("rate.{}: there is no state '{}'{}", name, name, did_you_mean(name, states)));
    for (const State& state : robot_.states) equations.rates.push_back(rate_of(state, given, line));
    return equations;
  }

  /// A state whose rate is another state needs no formula.
  Formula rate_of(const State& state, const Definitions& given, Index line) {
    const std::string& name = state.variable.name;
    for (const auto& [own, formula] : given)
      if (own == name) {
        if (const std::string& rate = state.variable.rate; !rate.empty() && formula.text != rate)
          violations_.add(formula.line,
                          fmt::format("rate.{} = \"{}\", but the rate of the state {} is \"{}\": one of them is "
                                      "wrong, and the other is enough",
                                      name, formula.text, name, rate));
        return formula;
      }
    if (!state.variable.rate.empty()) return {state.variable.rate, line};
    violations_.add(line,
                    fmt::format("rate.{} is missing: the derivative of {} by time, a formula; or program = […] or "
                                "model = \"…\" says what computes the dynamics",
                                name, name));
    return {};
  }

  ProgramSource read_program(Table& table, std::vector<std::string> command) {
    ProgramSource program{.command = std::move(command)};
    table.number("start_s", program.start_s, above(0));
    table.number("answer_s", program.answer_s, above(0));
    if (program.command.empty() || program.command.front().empty())
      table.wrong("program", "program = [\"python3\", \"simulator.py\"]: a program and its arguments");
    for (std::size_t i = 0; i < program.command.size(); ++i) {
      const std::string& argument = program.command[i];
      if (!kept_.keep(argument) && looks_like_a_file(argument, i == 0)) kept_.require(table, "program", argument);
    }
    kept_.take_files(table);
    return program;
  }

  Robot& robot_;
  KeptFiles kept_;
  std::vector<mujoco::ModelParameter> moved_;  // what parameters do to a model
  files::FileViolations& violations_;
};

}  // namespace

void read_dynamics(Table& file, Robot& robot, const scenario::ReadFile& read_file, files::FileViolations& violations) {
  DynamicsReader reader(robot, read_file, violations);
  for (const auto& [name, part] : file.tables("dynamics")) reader.read(name, *part);
}

}  // namespace rehearse::robot_file
