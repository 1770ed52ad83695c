#include <cctype>
#include <utility>

#include <fmt/format.h>

#include "rehearse/policy/exported_commands.hpp"
#include "rehearse/policy/exported_near.hpp"
#include "rehearse/policy/exported_text.hpp"

namespace rehearse::policy {
namespace {

constexpr const char* kFrame = R"(/* @NAME@: a @MARK@.
 *
@WHERE_FROM@ *
 *   int @NAME@_act(const double state[@STATES@], double time_s,@MEMORY_PARAMETER@ double action[@ACTIONS@]);
 *
@MEMORY_ABOUT@ * time_s is the time since the episode began. Actions are inside their bounds and 1 is returned; where a state or the
 * time is NaN or infinite, every action is NaN and 0 is returned: stop the robot. No finite state makes the floating-point
 * unit divide by zero, overflow or compute something invalid (clang: -ffp-exception-behavior=strict). Do not compile it
 * with -ffast-math.
 *
 * To test it:  cc -std=c99 -DREHEARSE_POLICY_MAIN -x c FILE -o test -lm && ./test
 */
#ifndef REHEARSE_POLICY_@UPPER@_H
#define REHEARSE_POLICY_@UPPER@_H

#include <math.h>

#define @UPPER@_STATES @STATES@
#define @UPPER@_ACTIONS @ACTIONS@
@MEMORY_DEFINE@#define @UPPER@_DT_S @DT_S@
#define @UPPER@_STEPS @STEPS@

/* NaN gives low: a compiler may compute ahead what is used for finite states alone. */
static inline double @NAME@_limit(double x, double low, double high) { return x > low ? x < high ? x : high : low; }

@MEMORY_START@static inline int @NAME@_act(const double @MEASURED@[@STATES@], double time_s,@MEMORY_PARAMETER@ double action[@ACTIONS@]) {
@JOINED@@NUMBERS@  int known = isfinite(time_s) ? 1 : 0;
  for (int i = 0; i < @ALL@; ++i)
    if (!isfinite(state[i])) known = 0;
  if (!known) {
    for (int o = 0; o < @ACTIONS@; ++o) action[o] = NAN;
    return 0;
  }
@COMPUTE@@COMMANDS@  return 1;
}

#ifdef REHEARSE_POLICY_MAIN
#include <stdio.h>

/* Whether the policy does here what it did there. */
int main(void) {
  enum { count = @COUNT@ };
  static const double states[count][@ALL@] =
    @TEST_STATES@;
  static const double times_s[count] =
    @TEST_TIMES@;
  static const double actions[count][@ACTIONS@] =
    @TEST_ACTIONS@;
  static const double range[@ACTIONS@] = @RANGES@;
  double state[@STATES@], action[@ACTIONS@], largest = 0;
@TEST_MEMORY@  int wrong = 0;
  for (int i = 0; i < count; ++i) {
@TEST_REMEMBERS@    wrong += @NAME@_act(states[i], times_s[i],@MEMORY_ARGUMENT@ action) != 1;
    for (int o = 0; o < @ACTIONS@; ++o) {
      const double apart = fabs(action[o] - actions[i][o]) / range[o];
      if (!(apart <= 1e-11)) ++wrong;
      if (apart > largest) largest = apart;
    }
  }
  for (int i = 0; i < @STATES@; ++i) state[i] = i == 0 ? (double)NAN : states[0][i];
  wrong += @NAME@_act(state, 0,@MEMORY_ARGUMENT@ action) != 0;
  printf("@NAME@: %d states, actions differ by at most %.2g of their range: %s\n", (int)count, largest,
         wrong ? "WRONG" : "as it should be");
  return wrong ? 1 : 0;
}
#endif

#endif
)";

constexpr const char* kClosedLoop = R"(  double input[@INPUTS@], a[@ACTIONS@];
@INPUT_LINES@@FORM@  for (int o = 0; o < @ACTIONS@; ++o) {
    @SQUASH@
    action[o] = @NAME@_limit((low[o] + high[o]) / 2 + (high[o] - low[o]) / 2 * squashed, low[o], high[o]);
  }
)";

constexpr const char* kTanh = "const double squashed = tanh(@GAIN@ * a[o]);";
constexpr const char* kSine = R"(const double sine = sin(@NAME@_limit(@GAIN@ * a[o], -1e4, 1e4));
    const double squashed = 0.5 * sine * (3 - sine * sine);)";

constexpr const char* kHidden = R"(  double unit[@UNITS@];
  for (int i = 0; i < @UNITS@; ++i) {
    double sum = hidden[i][@INPUTS@];
    for (int j = 0; j < @INPUTS@; ++j) sum += hidden[i][j] * input[j];
    unit[i] = tanh(sum);
  }
)";

constexpr const char* kOutput = R"(  for (int o = 0; o < @ACTIONS@; ++o) {
    a[o] = output[o][@BEFORE@];
    for (int i = 0; i < @BEFORE@; ++i) a[o] += output[o][i] * @LAYER@[i];
  }
)";

constexpr const char* kRadial = R"(  for (int o = 0; o < @ACTIONS@; ++o) {
    a[o] = 0;
    for (int c = 0; c < @CENTRES@; ++c) {
      double squared = 0;
      for (int i = 0; i < @INPUTS@; ++i) {
        const double apart = (input[i] - centre[c][i]) / length[o][i];
        squared += apart * apart;
      }
      if (squared < 1400) a[o] += weight[o][c] * exp(-0.5 * squared); /* beyond, it is nothing */
    }
  }
)";

constexpr const char* kTable = R"(  double row = @NAME@_limit(time_s, 0, @LARGEST_TIME@) * @PER_S@;
  row = @ROW@;
  for (int o = 0; o < @ACTIONS@; ++o) action[o] = table[(int)row][o];
)";

constexpr const char* kFeedback =
    R"(  const double place = @NAME@_limit(@NAME@_limit(time_s, 0, @LARGEST_TIME@) * @PER_S@, 0, @LAST@), turn = 6.283185307179586;
  const int row = (int)(place + 1e-9), stages = place - row > 1e-9 ? 2 : 1;
  double u[2][@ACTIONS@];
  for (int s = 0; s < stages; ++s) {
    for (int o = 0; o < @ACTIONS@; ++o) u[s][o] = planned[row + s][o];
    for (int i = 0; i < @ALL@; ++i) {
      double apart = @NAME@_limit(state[i], -@LARGEST_INPUT@, @LARGEST_INPUT@) - tracked[row + s][i];
      if (angle[i]) apart -= turn * floor(apart / turn + 0.5);
      for (int o = 0; o < @ACTIONS@; ++o) u[s][o] += gain[row + s][o * @ALL@ + i] * apart;
    }
  }
  for (int o = 0; o < @ACTIONS@; ++o) {
    if (stages == 2) u[0][o] += (place - row) * (u[1][o] - u[0][o]);
    action[o] = @NAME@_limit(u[0][o], low[o], high[o]);
  }
)";

constexpr std::pair<const char*, const char*> kMemory[] = {
    {"MEMORY_PARAMETER", " double memory[@MEMORY@],"},
    {"MEMORY_DEFINE", "#define @UPPER@_MEMORY @MEMORY@\n"},
    {"MEMORY_ABOUT",
     " * memory: the last commands. Call @NAME@_start(memory) before each episode, then @NAME@_act once a step.\n *\n"},
    {"MEMORY_START",
     "static inline void @NAME@_start(double memory[@MEMORY@]) {\n"
     "  static const double start[@MEMORY@] = @MEMORY_START_VALUES@;\n"
     "  for (int i = 0; i < @MEMORY@; ++i) memory[i] = start[i];\n}\n\n"},
    {"JOINED",
     "  double state[@ALL@];\n"
     "  for (int i = 0; i < @ALL@; ++i) state[i] = i < @STATES@ ? measured[i] : memory[i - @STATES@];\n"},
    {"TEST_MEMORY", "  double memory[@MEMORY@];\n  @NAME@_start(memory);\n"},
    {"TEST_REMEMBERS", "    for (int j = 0; j < @MEMORY@; ++j) memory[j] = states[i][@STATES@ + j];\n"}};

using Values = std::map<std::string, std::string>;

/// A table of numbers inside the function.
std::string constants(const std::string& name, const Matrix& values, const std::string& what) {
  return fmt::format("  static const double {}[{}][{}] = /* {} */\n    {};\n", name, values.rows(), values.cols(), what,
                     rows(values, {'{', '}', "    "}));
}

std::string list(const Vector& values) { return numbers(values, {'{', '}', "    "}); }

std::string input_lines(const std::vector<Input>& inputs, const std::string& name) {
  std::string lines;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto& [state, function, scale] = inputs[i];
    const std::string x = fmt::format("state[{}]", state);
    const std::string feature = function == Input::Function::cosine ? fmt::format("cos({})", x)
                                : function == Input::Function::sine
                                    ? fmt::format("sin({})", x)
                                    : fmt::format("{0}_limit({1}, -{2}, {2})", name, x, kLargestInput);
    lines += fmt::format("  input[{}] = {}{};\n", i, feature, scale == 1 ? "" : " / " + number(scale));
  }
  return lines;
}

/// Fills the frame's places for the memory of actuators; empty without one.
void add_memory(const Exported& exported, const std::string& name, Values& values) {
  for (const char* part : {"MEMORY_PARAMETER", "MEMORY_ARGUMENT", "MEMORY_ABOUT", "MEMORY_DEFINE", "MEMORY_START",
                           "JOINED", "COMMANDS", "TEST_MEMORY", "TEST_REMEMBERS"})
    values[part] = "";
  values["MEASURED"] = "state";
  const Index size = memory(exported);
  if (size == 0) return;
  values["MEMORY"] = std::to_string(size);
  values["MEMORY_START_VALUES"] = list(exported.actuators.start());
  values["MEASURED"] = "measured";
  values["MEMORY_ARGUMENT"] = " memory,";
  for (const auto& [part, text] : kMemory) values[part] = filled(text, values);
  const auto remembered = [own = measured(exported)](Index state) { return fmt::format("memory[{}]", state - own); };
  values["COMMANDS"] =
      "  /* Commands follow from the last ones, and are remembered. */\n" +
      command_lines(exported.actuators, {.action = [](Index a) { return fmt::format("action[{}]", a); },
                                         .before = remembered,
                                         .after = remembered,
                                         .limited = name + "_limit({0}, {1}, {2})",
                                         .end = ";",
                                         .indent = "  "});
}

/// NUMBERS and COMPUTE of a description.
class Body {
 public:
  Body(const Exported& exported, Values& values) : exported_(exported), values_(values) {}

  void operator()(const Layers& layers) {
    const Index units = layers.hidden.rows(), inputs = static_cast<Index>(layers.inputs.size());
    values_["UNITS"] = std::to_string(units);
    values_["BEFORE"] = std::to_string(units > 0 ? units : inputs);
    values_["LAYER"] = units > 0 ? "unit" : "input";
    std::string tables;
    if (units > 0) tables += constants("hidden", layers.hidden, "each unit's weights of the inputs, then its bias");
    tables += constants("output", layers.output, "each action's weights, then its bias");
    closed_loop(layers.inputs, layers.squash, tables, std::string(units > 0 ? kHidden : "") + kOutput);
  }

  void operator()(const Radial& radial) {
    values_["CENTRES"] = std::to_string(radial.centres.rows());
    closed_loop(radial.inputs, radial.squash,
                constants("centre", radial.centres, "in the space of the inputs") +
                    constants("length", radial.lengths, "each action's, of each input") +
                    constants("weight", radial.weights, "each action's, of each centre"),
                kRadial);
  }

  void operator()(const Table& table) {
    values_["NUMBERS"] = constants("table", table.actions, "the actions, row by row");
    values_["PER_S"] = number(table.per_s);
    values_["LARGEST_TIME"] = kLargestTime;
    const double last = static_cast<double>(table.actions.rows()) - 1;
    values_["ROW"] = table.periodic ? fmt::format("fmod(round(row), {})", number(last + 1))
                                    : fmt::format("{}_limit(round(row), 0, {})", values_.at("NAME"), number(last));
    values_["COMPUTE"] = filled(kTable, values_);
  }

  void operator()(const Feedback& feedback) {
    std::string angles;
    for (const bool angle : feedback.angles) angles += fmt::format("{}{:d}", angles.empty() ? "" : ", ", angle);
    values_["NUMBERS"] = constants("planned", feedback.actions, "the actions, row by row") +
                         constants("tracked", feedback.states, "where they belong") +
                         constants("gain", feedback.gains, "what a difference from there adds to each action") +
                         fmt::format("  static const int angle[{}] = {{{}}};\n", feedback.angles.size(), angles) +
                         range_lines();
    values_["PER_S"] = number(feedback.per_s);
    values_["LARGEST_TIME"] = kLargestTime;
    values_["LARGEST_INPUT"] = kLargestInput;
    values_["LAST"] = number(static_cast<double>(feedback.actions.rows()) - 1);
    values_["COMPUTE"] = filled(kFeedback, values_);
  }

 private:
  std::string range_lines() const {
    return fmt::format("  static const double low[{0}] = {1};\n  static const double high[{0}] = {2};\n",
                       values_.at("ACTIONS"), list(lows(exported_)), list(highs(exported_)));
  }

  void closed_loop(const std::vector<Input>& inputs, const Squash& squash, const std::string& tables,
                   const std::string& form) {
    values_["INPUTS"] = std::to_string(inputs.size());
    values_["INPUT_LINES"] = input_lines(inputs, values_.at("NAME"));
    values_["GAIN"] = number(squash.gain);
    values_["SQUASH"] = filled(squash.shape == Squash::Shape::tanh ? kTanh : kSine, values_);
    values_["FORM"] = filled(form, values_);
    values_["NUMBERS"] = tables + range_lines();
    values_["COMPUTE"] = filled(kClosedLoop, values_);
  }

  const Exported& exported_;
  Values& values_;
};

}  // namespace

std::string to_c(const Exported& exported, const std::string& name) {
  Values values = {{"NAME", name},
                   {"UPPER", name},
                   {"ALL", std::to_string(exported.states.size())},
                   {"COUNT", std::to_string(exported.answers.states.rows())},
                   {"TEST_STATES", rows(exported.answers.states, {'{', '}', "    "})},
                   {"TEST_TIMES", list(exported.answers.times_s)},
                   {"TEST_ACTIONS", rows(exported.answers.actions, {'{', '}', "    "})},
                   {"RANGES", list(highs(exported) - lows(exported))}};
  values.merge(common_values(exported));
  for (char& c : values["UPPER"]) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (const std::string& line : explanation(exported)) values["WHERE_FROM"] += " * " + line + "\n";
  add_memory(exported, name, values);
  std::visit(Body(exported, values), exported.description.form);
  values["COMPUTE"] += near_in_c(exported, name);
  return filled(kFrame, values);
}

}  // namespace rehearse::policy
