#include "rehearse/policy/exported_text.hpp"

#include <fmt/format.h>

#include "rehearse/core/names.hpp"

namespace rehearse::policy {
namespace {

constexpr std::size_t kLine = 120;

/// The text without control characters, ends of comments, and trigraphs.
std::string harmless(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    const char before = safe.empty() ? ' ' : safe.back();
    const bool breaks = (before == '*' && c == '/') || (before == '/' && c == '*') || (before == '?' && c == '?');
    if (breaks) safe += ' ';
    const auto byte = static_cast<unsigned char>(c);
    safe += byte < 0x20 || byte == 0x7f || c == '\\' ? '_' : c;
  }
  return safe;
}

/// Parts with commas between, in brackets; a new line where one would be too long.
std::string bracketed(const std::vector<std::string>& parts, const Brackets& brackets) {
  std::string text(1, brackets.open);
  std::size_t column = brackets.indent.size() + 1;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += ',';
    if (i > 0 && column + parts[i].size() + 3 > kLine)
      text += "\n" + brackets.indent + " ", column = brackets.indent.size() + 1;
    else if (i > 0)
      text += ' ';
    text += parts[i];
    column += parts[i].size() + 2;
  }
  return text + brackets.close;
}

std::string state_line(const Exported& exported, Index i) {
  const StateVariable& state = exported.states[static_cast<std::size_t>(i)];
  const Index own = measured(exported);
  return fmt::format("{} {}", i < own ? fmt::format("state {:<4}", i) : fmt::format("memory {:<3}", i - own),
                     labelled(state.name, state.unit));
}

Vector bounds(const Exported& exported, double Interval::*end) {
  Vector ends(static_cast<Index>(exported.actions.size()));
  for (Index a = 0; a < ends.size(); ++a) ends(a) = exported.actions[static_cast<std::size_t>(a)].bounds.*end;
  return ends;
}

}  // namespace

std::string number(double value) {
  std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string numbers(const Vector& values, const Brackets& brackets) {
  std::vector<std::string> parts;
  for (const double value : values) parts.push_back(number(value));
  return bracketed(parts, brackets);
}

std::string rows(const Matrix& values, const Brackets& brackets) {
  const Brackets inner{brackets.open, brackets.close, brackets.indent + " "};
  std::string text(1, brackets.open);
  for (Index i = 0; i < values.rows(); ++i) text += (i > 0 ? ",\n" + inner.indent : "") + numbers(values.row(i), inner);
  return text + brackets.close;
}

std::string filled(std::string_view text, const std::map<std::string, std::string>& values) {
  std::string result;
  while (true) {
    const std::size_t begin = text.find('@');
    result += text.substr(0, begin);
    if (begin == std::string_view::npos) return result;
    const std::size_t end = text.find('@', begin + 1);
    result += values.at(std::string(text.substr(begin + 1, end - begin - 1)));
    text.remove_prefix(end + 1);
  }
}

std::map<std::string, std::string> common_values(const Exported& exported) {
  return {{"MARK", kExportedMark},
          {"STATES", std::to_string(measured(exported))},
          {"ACTIONS", std::to_string(exported.actions.size())},
          {"DT_S", number(exported.dt_s)},
          {"STEPS", std::to_string(exported.horizon)}};
}

std::string labelled(const std::string& name, const std::string& unit) { return harmless(with_unit(name, unit)); }

std::vector<std::string> explanation(const Exported& exported) {
  const Origin& from = exported.origin;
  const std::string prior = from.prior.empty() ? "" : ", prior " + from.prior;
  std::vector<std::string> lines = {
      harmless(fmt::format("robot      {}", from.robot)),
      harmless(fmt::format("learner    {}{}, seed {}", from.learner, prior, from.seed)),
      fmt::format("trial      {}, {}", from.trial,
                  from.total_reward ? fmt::format("return {}", *from.total_reward) : "which is to come"),
      harmless(fmt::format("policy     {}", exported.kind)),
      fmt::format("time step  {} s: act once each step, and hold the actions until the next", exported.dt_s)};
  for (std::size_t i = 0; i < exported.states.size(); ++i) lines.push_back(state_line(exported, static_cast<Index>(i)));
  for (std::size_t i = 0; i < exported.actions.size(); ++i) {
    const ActionVariable& action = exported.actions[i];
    lines.push_back(fmt::format("action {:<3} {}, from {} to {}", i, labelled(action.name, action.unit),
                                action.bounds.low, action.bounds.high));
  }
  return lines;
}

Index measured(const Exported& exported) {
  return static_cast<Index>(exported.states.size()) - exported.actuators.memory();
}
Index memory(const Exported& exported) { return exported.actuators.memory(); }

Vector lows(const Exported& exported) { return bounds(exported, &Interval::low); }
Vector highs(const Exported& exported) { return bounds(exported, &Interval::high); }

}  // namespace rehearse::policy
