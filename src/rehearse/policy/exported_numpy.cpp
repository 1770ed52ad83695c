#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rehearse/policy/exported_commands.hpp"
#include "rehearse/policy/exported_near.hpp"
#include "rehearse/policy/exported_text.hpp"

namespace rehearse::policy {
namespace {

constexpr const char* kFrame = R"PY(# A @MARK@.
#
@WHERE_FROM@import numpy as np

STATES, ACTIONS = @STATE_NAMES@, @ACTION_NAMES@
DT_S, STEPS = @DT_S@, @STEPS@
LOW, HIGH = np.array(@LOW@), np.array(@HIGH@)
@NUMBERS@

@MEMORY_START@def act(states, @T@):
    """Actions (n x @ACTIONS@) in the states (n x @STATES@) at time t [s] since the episode began, one or n of them; of one state
    alone its actions alone.@MEMORY_ABOUT@ NaN where a state or the time is not finite, else inside their bounds."""
    given = np.asarray(states, dtype=float)
    x = np.atleast_2d(given)
@JOINED@    t = np.broadcast_to(np.asarray(t, dtype=float), len(x))
    known = np.isfinite(x).all(axis=1) & np.isfinite(t)
    x, t = np.where(known[:, None], x, 0.0), np.where(known, t, 0.0)
@COMPUTE@@COMMANDS@    u[~known] = np.nan
    return u if given.ndim == 2 else u[0]


TEST_STATES = np.array(
    @TEST_STATES@)
TEST_TIMES = np.array(
    @TEST_TIMES@)
TEST_ACTIONS = np.array(
    @TEST_ACTIONS@)

if __name__ == "__main__":
    apart = np.abs(act(@TEST_GIVEN@) - TEST_ACTIONS) / (HIGH - LOW)
    print(f"{len(apart)} states, actions differ by at most {apart.max():.2g} of their range")
    raise SystemExit(not (apart <= 1e-11).all())
)PY";

constexpr const char* kClosedLoop = R"PY(    limit = @LARGEST_INPUT@
    inputs = np.stack([
@INPUT_LINES@    ], axis=1)
@FORM@@SQUASH@    u = np.clip((LOW + HIGH) / 2 + (HIGH - LOW) / 2 * squashed, LOW, HIGH)
)PY";

constexpr const char* kTanh = "    squashed = np.tanh(@GAIN@ * a)\n";
constexpr const char* kSine = R"PY(    sine = np.sin(np.clip(@GAIN@ * a, -1e4, 1e4))
    squashed = 0.5 * sine * (3 - sine * sine)
)PY";

constexpr const char* kHidden = "    inputs = np.tanh(inputs @AT@ HIDDEN[:, :-1].T + HIDDEN[:, -1])\n";
constexpr const char* kOutput = "    a = inputs @AT@ OUTPUT[:, :-1].T + OUTPUT[:, -1]\n";

constexpr const char* kRadial = R"PY(    a = np.empty((len(x), @ACTIONS@))
    for o in range(@ACTIONS@):
        squared = (((inputs[:, None, :] - CENTRES) / LENGTHS[o]) ** 2).sum(axis=2)
        a[:, o] = np.exp(-0.5 * np.minimum(squared, 1400.0)) @AT@ WEIGHTS[o]
)PY";

constexpr const char* kTable = R"PY(    row = np.floor(np.clip(t, 0.0, @LARGEST_TIME@) * @PER_S@ + 0.5)
    u = TABLE[@ROW@.astype(int)]
)PY";

constexpr const char* kFeedback = R"PY(
    def of_stage(row):
        apart = np.clip(x, -@LARGEST_INPUT@, @LARGEST_INPUT@) - TRACKED[row]
        apart = np.where(ANGLES, apart - 2 * np.pi * np.floor(apart / (2 * np.pi) + 0.5), apart)
        return PLANNED[row] + (GAINS[row].reshape(len(x), @ACTIONS@, -1) * apart[:, None, :]).sum(axis=2)

    place = np.clip(np.clip(t, 0.0, @LARGEST_TIME@) * @PER_S@, 0.0, @LAST@)
    row = (place + 1e-9).astype(int)
    beyond = np.where(place - row > 1e-9, place - row, 0.0)[:, None]
    u, after = of_stage(row), of_stage(np.minimum(row + 1, @LAST@))
    u = np.clip(u + beyond * (after - u), LOW, HIGH)
)PY";

constexpr const char* kStart = R"PY(def start(n=None):
    """The memory of n episodes before their first step (n rows), or of one."""
    memory = np.array({})
    return memory if n is None else np.tile(memory, (n, 1))


)PY";

using Values = std::map<std::string, std::string>;

std::string array(const std::string& name, const Matrix& values) {
  return fmt::format("{} = np.array(\n    {})\n", name, rows(values, {'[', ']', "    "}));
}

std::string input_lines(const std::vector<Input>& inputs) {
  std::string lines;
  for (const auto& [state, function, scale] : inputs) {
    const char* form = function == Input::Function::cosine ? "np.cos(x[:, {}])"
                       : function == Input::Function::sine ? "np.sin(x[:, {}])"
                                                           : "np.clip(x[:, {}], -limit, limit)";
    lines +=
        fmt::format("        {}{},\n", fmt::format(fmt::runtime(form), state), scale == 1 ? "" : " / " + number(scale));
  }
  return lines;
}

/// Fills the frame's places for the memory of actuators; empty without one.
void add_memory(const Exported& exported, Values& values) {
  for (const char* part : {"MEMORY_START", "MEMORY_ABOUT", "JOINED", "COMMANDS"}) values[part] = "";
  values["T"] = "t=0.0";
  values["TEST_GIVEN"] = "TEST_STATES, TEST_TIMES";
  if (memory(exported) == 0) return;
  values["T"] = "t, memory";
  values["TEST_GIVEN"] =
      fmt::format("TEST_STATES[:, :{0}], TEST_TIMES, TEST_STATES[:, {0}:].copy()", measured(exported));
  values["MEMORY_ABOUT"] =
      "\n    memory: what start() gave before the first step, of as many episodes. It holds the last commands, and is\n"
      "    changed: act once each time step.";
  values["MEMORY_START"] = fmt::format(kStart, numbers(exported.actuators.start(), {'[', ']', "    "}));
  values["JOINED"] = "    memory_rows = np.atleast_2d(memory)\n    x = np.hstack([x, memory_rows])\n";
  const auto after = [own = measured(exported)](Index state) { return fmt::format("new[:, {}]", state - own); };
  values["COMMANDS"] = "    new = memory_rows.copy()\n" +
                       command_lines(exported.actuators, {.action = [](Index a) { return fmt::format("u[:, {}]", a); },
                                                          .before = [](Index s) { return fmt::format("x[:, {}]", s); },
                                                          .after = after,
                                                          .limited = "np.clip({0}, {1}, {2})",
                                                          .end = "",
                                                          .indent = "    "}) +
                       "    memory_rows[known] = new[known]\n";
}

/// NUMBERS and COMPUTE of a description.
class Body {
 public:
  explicit Body(Values& values) : values_(values) {}

  void operator()(const Layers& layers) {
    const bool hidden = layers.hidden.rows() > 0;
    values_["NUMBERS"] = (hidden ? array("HIDDEN", layers.hidden) : "") + array("OUTPUT", layers.output);
    closed_loop(layers.inputs, layers.squash, std::string(hidden ? kHidden : "") + kOutput);
  }

  void operator()(const Radial& radial) {
    values_["NUMBERS"] =
        array("CENTRES", radial.centres) + array("LENGTHS", radial.lengths) + array("WEIGHTS", radial.weights);
    closed_loop(radial.inputs, radial.squash, kRadial);
  }

  void operator()(const Table& table) {
    values_["NUMBERS"] = array("TABLE", table.actions);
    values_["PER_S"] = number(table.per_s);
    values_["LARGEST_TIME"] = kLargestTime;
    values_["ROW"] = table.periodic ? fmt::format("np.fmod(row, {})", table.actions.rows())
                                    : fmt::format("np.minimum(row, {})", table.actions.rows() - 1);
    values_["COMPUTE"] = filled(kTable, values_);
  }

  void operator()(const Feedback& feedback) {
    std::string angles;
    for (const bool angle : feedback.angles)
      angles += fmt::format("{}{}", angles.empty() ? "" : ", ", angle ? "True" : "False");
    values_["NUMBERS"] = array("PLANNED", feedback.actions) + array("TRACKED", feedback.states) +
                         array("GAINS", feedback.gains) + fmt::format("ANGLES = np.array([{}])\n", angles);
    values_["PER_S"] = number(feedback.per_s);
    values_["LARGEST_TIME"] = kLargestTime;
    values_["LARGEST_INPUT"] = kLargestInput;
    values_["LAST"] = std::to_string(feedback.actions.rows() - 1);
    values_["COMPUTE"] = filled(kFeedback, values_);
  }

 private:
  void closed_loop(const std::vector<Input>& inputs, const Squash& squash, const std::string& form) {
    values_["AT"] = "@";
    values_["LARGEST_INPUT"] = kLargestInput;
    values_["INPUT_LINES"] = input_lines(inputs);
    values_["GAIN"] = number(squash.gain);
    values_["FORM"] = filled(form, values_);
    values_["SQUASH"] = filled(squash.shape == Squash::Shape::tanh ? kTanh : kSine, values_);
    values_["COMPUTE"] = filled(kClosedLoop, values_);
  }

  Values& values_;
};

/// ["angle [rad]", …] in ASCII.
template <class Variables>
std::string names(const Variables& variables) {
  nlohmann::json all = nlohmann::json::array();
  for (const auto& variable : variables) all.push_back(labelled(variable.name, variable.unit));
  return all.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

std::string list(const Vector& values) { return numbers(values, {'[', ']', "    "}); }
std::string table(const Matrix& values) { return rows(values, {'[', ']', "    "}); }

}  // namespace

std::string to_numpy(const Exported& exported) {
  Values values = {
      {"STATE_NAMES", names(std::vector(exported.states.begin(), exported.states.end() - memory(exported)))},
      {"ACTION_NAMES", names(exported.actions)},
      {"LOW", list(lows(exported))},
      {"HIGH", list(highs(exported))},
      {"TEST_STATES", table(exported.answers.states)},
      {"TEST_TIMES", list(exported.answers.times_s)},
      {"TEST_ACTIONS", table(exported.answers.actions)}};
  values.merge(common_values(exported));
  for (const std::string& line : explanation(exported)) values["WHERE_FROM"] += "# " + line + "\n";
  add_memory(exported, values);
  std::visit(Body(values), exported.description.form);
  values["COMPUTE"] += near_in_numpy(exported);
  return filled(kFrame, values);
}

}  // namespace rehearse::policy
