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
    Channel channel{.last_command = states(), .start_command = within(0, action.bounds.low, action.bounds.high)};
    channel.max_change = max_rate * dt_s;
    if (filter_s > 0) channel.filter_gain = -std::expm1(-dt_s / filter_s);
    const bool changes = filter_s > 0 || std::isfinite(max_rate);
    changes_commands_ |= changes;
    const double steps = std::max(0.0, delay_s / dt_s);
    channel.delay_steps = index(std::floor(steps + kRounding));
    channel.delay_fraction = std::max(0.0, steps - static_cast<double>(channel.delay_steps));
    if (channel.delay_fraction < kRounding) channel.delay_fraction = 0;
    channel.kept = std::max({remember, Index{changes}, channel.delay_steps + Index{channel.delay_fraction > 0}});
    memory_ += channel.kept;
    if (lag_s > 0) {
      channel.reached_state = states();
      channel.lag_decay = std::exp(-dt_s / lag_s);
      channel.mean_lag_decay = -std::expm1(-dt_s / lag_s) * lag_s / dt_s;
      ++memory_;
    }
    channels_.push_back(channel);
  }
}

std::vector<StateVariable> Actuators::variables() const {
  std::vector<StateVariable> variables;
  for (std::size_t a = 0; a < channels_.size(); ++a) {
    const std::string &name = actions_[a].name, &unit = actions_[a].unit;
    for (Index k = 1; k <= channels_[a].kept; ++k)
      variables.push_back({name + "_last" + (k > 1 ? std::to_string(k) : ""), unit});
    if (channels_[a].reached_state >= 0) variables.push_back({name + "_reached", unit});
  }
  return variables;
}

Vector Actuators::start() const {
  Vector start(memory_);
  for (const Channel& channel : channels_)
    start.segment(channel.last_command - own_states_, channel.kept + Index{channel.reached_state >= 0})
        .setConstant(channel.start_command);
  return start;
}

Vector Actuators::scale() const {
  Vector scale(memory_);
  for (std::size_t a = 0; a < channels_.size(); ++a) {
    const auto& [low, high] = actions_[a].bounds;
    scale.segment(channels_[a].last_command - own_states_, channels_[a].kept + Index{channels_[a].reached_state >= 0})
        .setConstant(std::max(std::abs(low), std::abs(high)));
  }
  return scale;
}

void Actuators::command(const ConstMatrixView& X, MatrixView U) const {
  if (!changes_commands_) return;
  for (Index a = 0; a < U.cols(); ++a) {
    const Channel& channel = channels_[static_cast<std::size_t>(a)];
    if (channel.filter_gain == 1 && !std::isfinite(channel.max_change)) continue;
    for (Index row = 0; row < U.rows(); ++row) {
      const double before = X(row, channel.last_command), wanted = U(row, a);
      const double passed = channel.filter_gain < 1 ? before + channel.filter_gain * (wanted - before) : wanted;
      U(row, a) = within(passed, before - channel.max_change, before + channel.max_change);
    }
  }
}

/// The mean over the step of the command that arrives.
auto Actuators::held(const Channel& channel, Index action, const ConstMatrixView& X, const ConstMatrixView& U) const {
  const auto sent = [&](Index ago) { return ago == 0 ? U.col(action) : X.col(channel.last_command + ago - 1); };
  const Index older = channel.delay_fraction > 0 ? channel.delay_steps + 1 : channel.delay_steps;
  return (1 - channel.delay_fraction) * sent(channel.delay_steps) + channel.delay_fraction * sent(older);
}

void Actuators::moving(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView E) const {
  for (Index a = 0; a < U.cols(); ++a) {
    const Channel& channel = channels_[static_cast<std::size_t>(a)];
    E.col(a) = held(channel, a, X, U);
    if (channel.reached_state >= 0) E.col(a) += channel.mean_lag_decay * (X.col(channel.reached_state) - E.col(a));
  }
}

void Actuators::remember(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView X_next) const {
  for (Index a = 0; a < U.cols(); ++a) {
    const Channel& channel = channels_[static_cast<std::size_t>(a)];
    if (channel.kept > 0) X_next.col(channel.last_command) = U.col(a);
    for (Index k = 1; k < channel.kept; ++k) X_next.col(channel.last_command + k) = X.col(channel.last_command + k - 1);
    if (channel.reached_state < 0) continue;
    X_next.col(channel.reached_state) = held(channel, a, X, U);
    X_next.col(channel.reached_state) +=
        channel.lag_decay * (X.col(channel.reached_state) - X_next.col(channel.reached_state));
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
