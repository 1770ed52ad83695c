#include "rehearse/policy/exported_near.hpp"

#include <fmt/format.h>

#include "rehearse/policy/exported_text.hpp"

namespace rehearse::policy {
namespace {

constexpr const char* kNearInC = R"(  { /* Near the goal linear feedback takes over. */
    static const double goal[@ALL@] = @STATE@;
    static const double held[@ACTIONS@] = @ACTION@;
    static const double to_goal[@ACTIONS@][@ALL@] =
      @GAIN@;
    static const double shape[@ALL@][@ALL@] =
      @SHAPE@;
    static const int turns[@ALL@] = {@ANGLES@};
    static const double lowest[@ACTIONS@] = @LOWS@, highest[@ACTIONS@] = @HIGHS@, turn = 6.283185307179586;
    double apart[@ALL@], inside = 0;
    for (int i = 0; i < @ALL@; ++i) {
      apart[i] = @NAME@_limit(state[i], -@LARGEST_INPUT@, @LARGEST_INPUT@) - goal[i];
      if (turns[i]) apart[i] -= turn * floor(apart[i] / turn + 0.5);
    }
    for (int i = 0; i < @ALL@; ++i) {
      double along = 0;
      for (int j = 0; j < @ALL@; ++j) along += shape[i][j] * apart[j];
      inside += apart[i] * along;
    }
    for (int o = 0; o < @ACTIONS@ && inside < 1; ++o) {
      double u = held[o];
      for (int i = 0; i < @ALL@; ++i) u += to_goal[o][i] * apart[i];
      action[o] = @NAME@_limit(u, lowest[o], highest[o]);
    }
  }
)";

constexpr const char* kNearInNumpy = R"PY(    # Near the goal linear feedback takes over.
    apart = np.clip(x, -@LARGEST_INPUT@, @LARGEST_INPUT@) - np.array(@STATE@)
    apart = np.where([@ANGLES@], apart - 2 * np.pi * np.floor(apart / (2 * np.pi) + 0.5), apart)
    shape = np.array(
        @SHAPE@)
    gain = np.array(
        @GAIN@)
    held = np.clip(np.array(@ACTION@) + apart @AT@ gain.T, LOW, HIGH)
    u = np.where(((apart * (apart @AT@ shape.T)).sum(axis=1) < 1)[:, None], held, u)
)PY";

/// How a language writes numbers.
struct Notation {
  Brackets line, table;
  const char *yes, *no;
};

std::map<std::string, std::string> values_of(const Near& near, const Notation& write) {
  std::string angles;
  for (const bool angle : near.angles)
    angles += fmt::format("{}{}", angles.empty() ? "" : ", ", angle ? write.yes : write.no);
  return {{"ALL", std::to_string(near.state.size())},
          {"ACTIONS", std::to_string(near.action.size())},
          {"STATE", numbers(near.state, write.line)},
          {"ACTION", numbers(near.action, write.line)},
          {"GAIN", rows(near.gain, write.table)},
          {"SHAPE", rows(near.shape, write.table)},
          {"ANGLES", angles},
          {"LARGEST_INPUT", kLargestInput}};
}

}  // namespace

std::string near_in_c(const Exported& exported, const std::string& name) {
  if (!exported.description.near) return "";
  const Brackets brackets{'{', '}', "      "};
  auto values = values_of(*exported.description.near, {brackets, brackets, "1", "0"});
  values["NAME"] = name;
  values["LOWS"] = numbers(lows(exported), brackets);
  values["HIGHS"] = numbers(highs(exported), brackets);
  return filled(kNearInC, values);
}

std::string near_in_numpy(const Exported& exported) {
  if (!exported.description.near) return "";
  const Brackets brackets{'[', ']', "        "};
  auto values = values_of(*exported.description.near, {brackets, brackets, "True", "False"});
  values["AT"] = "@";
  return filled(kNearInNumpy, values);
}

}  // namespace rehearse::policy
