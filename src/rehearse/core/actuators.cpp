#include "rehearse/core/actuators.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse {
namespace {

constexpr double kRounding = 1e-9;  // of a step: so much later is still that step

Index index(double value) { return static_cast<Index>(value); }

/// The value moved into [low, high]; a NaN stays that NaN.
double within(double value, double low, double high) { return value < low ? low : value > high ? high : value; }

}  // namespace

Actuators::Actuators(const std::vector<ActionVariable>& actions, double dt_s, Index own_states)
    : actions_(actions), own_states_(own_states) {
  for (const ActionVariable& action : actions) {
    const auto& [max_rate, filter_s, delay_s, lag_s, remember] = action.actuation;
    Line line{.first = states(), .start = within(0, action.bounds.low, action.bounds.high)};
    line.max_step = max_rate * dt_s;
    if (filter_s > 0) line.passes = -std::expm1(-dt_s / filter_s);
    const bool changes = filter_s > 0 || std::isfinite(max_rate);
    changes_commands_ |= changes;
    const double steps = std::max(0.0, delay_s / dt_s);
    line.delay = index(std::floor(steps + kRounding));
    line.further = std::max(0.0, steps - static_cast<double>(line.delay));
    if (line.further < kRounding) line.further = 0;
    line.before = std::max({remember, Index{changes}, line.delay + Index{line.further > 0}});
    memory_ += line.before;
    if (lag_s > 0) {
      line.reached = states();
      line.stays = std::exp(-dt_s / lag_s);
      line.mean_stays = -std::expm1(-dt_s / lag_s) * lag_s / dt_s;
      ++memory_;
    }
    lines_.push_back(line);
  }
}

std::vector<StateVariable> Actuators::variables() const {
  std::vector<StateVariable> variables;
  for (std::size_t a = 0; a < lines_.size(); ++a) {
    const std::string &name = actions_[a].name, &unit = actions_[a].unit;
    for (Index k = 1; k <= lines_[a].before; ++k)
      variables.push_back({name + "_last" + (k > 1 ? std::to_string(k) : ""), unit});
    if (lines_[a].reached >= 0) variables.push_back({name + "_reached", unit});
  }
  return variables;
}

Vector Actuators::start() const {
  Vector start(memory_);
  for (const Line& line : lines_)
    start.segment(line.first - own_states_, line.before + Index{line.reached >= 0}).setConstant(line.start);
  return start;
}

Vector Actuators::scale() const {
  Vector scale(memory_);
  for (std::size_t a = 0; a < lines_.size(); ++a) {
    const auto& [low, high] = actions_[a].bounds;
    scale.segment(lines_[a].first - own_states_, lines_[a].before + Index{lines_[a].reached >= 0})
        .setConstant(std::max(std::abs(low), std::abs(high)));
  }
  return scale;
}

void Actuators::command(const ConstMatrixView& X, MatrixView U) const {
  if (!changes_commands_) return;
  for (Index a = 0; a < U.cols(); ++a) {
    const Line& line = lines_[static_cast<std::size_t>(a)];
    if (line.passes == 1 && !std::isfinite(line.max_step)) continue;
    for (Index row = 0; row < U.rows(); ++row) {
      const double before = X(row, line.first), wanted = U(row, a);
      const double passed = line.passes < 1 ? before + line.passes * (wanted - before) : wanted;
      U(row, a) = within(passed, before - line.max_step, before + line.max_step);
    }
  }
}

/// The mean over the step of the command that arrives.
auto Actuators::held(const Line& line, Index action, const ConstMatrixView& X, const ConstMatrixView& U) const {
  const auto sent = [&](Index ago) { return ago == 0 ? U.col(action) : X.col(line.first + ago - 1); };
  const Index older = line.further > 0 ? line.delay + 1 : line.delay;
  return (1 - line.further) * sent(line.delay) + line.further * sent(older);
}

void Actuators::moving(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView E) const {
  for (Index a = 0; a < U.cols(); ++a) {
    const Line& line = lines_[static_cast<std::size_t>(a)];
    E.col(a) = held(line, a, X, U);
    if (line.reached >= 0) E.col(a) += line.mean_stays * (X.col(line.reached) - E.col(a));
  }
}

void Actuators::remember(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView X_next) const {
  for (Index a = 0; a < U.cols(); ++a) {
    const Line& line = lines_[static_cast<std::size_t>(a)];
    if (line.before > 0) X_next.col(line.first) = U.col(a);
    for (Index k = 1; k < line.before; ++k) X_next.col(line.first + k) = X.col(line.first + k - 1);
    if (line.reached < 0) continue;
    X_next.col(line.reached) = held(line, a, X, U);
    X_next.col(line.reached) += line.stays * (X.col(line.reached) - X_next.col(line.reached));
  }
}

Matrix Actuators::memory_of(const ConstMatrixView& commands) const {
  Matrix all(commands.rows() + 1, memory_), now(1, states()), next(1, states());
  all.row(0) = start().transpose();
  for (Index t = 0; t < commands.rows(); ++t) {
    now.rightCols(memory_) = all.row(t);
    remember(now, commands.middleRows(t, 1), next);
    all.row(t + 1) = next.rightCols(memory_);
  }
  return all;
}

std::vector<std::string> Actuators::violations(const ActionVariable& action, double dt_s) {
  const auto& [max_rate, filter_s, delay_s, lag_s, remember] = action.actuation;
  Violations found;
  const auto require = [&](bool good, const char* what, double value, const std::string& bound) {
    found.require(good, fmt::format("action {}: {} = {}, must be {}", action.name, what, value, bound));
  };
  require(max_rate > 0, "max_rate", max_rate, "> 0");
  require(filter_s >= 0 && std::isfinite(filter_s), "filter_s", filter_s, "≥ 0");
  if (dt_s > 0)  // else that is what is wrong
    require(delay_s >= 0 && delay_s <= kMostSteps * dt_s * (1 + kRounding), "delay_s", delay_s,
            fmt::format("in 0 to {} (100 control steps)", kMostSteps * dt_s));
  require(lag_s >= 0 && std::isfinite(lag_s), "lag_s", lag_s, "≥ 0");
  require(remember >= 0 && static_cast<double>(remember) <= kMostSteps, "remember", static_cast<double>(remember),
          "in 0 to 100");
  return found.list();
}

}  // namespace rehearse
