#include "rehearse/rollout/lockstep.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "rehearse/rollout/step_slopes.hpp"

namespace rehearse::rollout {

Lockstep::Lockstep(const Simulation& of, Index rows, LockstepMemory& memory)
    : model_(of.model), policy_(of.policy), task_(of.task), key_(of.key), options_(of.options), m_(memory) {
  m_.Theta.resize(rows, policy_.parameters());
  m_.X.resize(rows, task_.state_size());
  if (remembers_actions()) m_.U_before.setZero(rows, task_.action_size());
  resize(rows);
  m_.broken.setZero(rows, m_.holds.cols());
  m_.returns.setZero(rows);
  m_.places.resize(static_cast<std::size_t>(rows));
  std::iota(m_.places.begin(), m_.places.end(), 0);
}

/// Gives the numbers that a step computes so many rows, all of them alive.
void Lockstep::resize(Index rows) {
  for (Matrix* states : {&m_.seen, &m_.next, &m_.noise}) states->resize(rows, task_.state_size());
  m_.U.resize(rows, task_.action_size());
  m_.reward.resize(rows);
  if (task_.cost) m_.cost.resize(rows);
  m_.holds.resize(rows, static_cast<Index>(task_.limits.size()));
  m_.ended.setZero(rows);
  m_.candidates.resize(static_cast<std::size_t>(rows));
  m_.particles.resize(static_cast<std::size_t>(rows));
  m_.alive.assign(static_cast<std::size_t>(rows), true);
}

void Lockstep::set_row(Index row, const ConstVectorView& theta, std::uint64_t candidate, std::uint64_t particle) {
  m_.Theta.row(row) = theta.transpose();
  m_.candidates[static_cast<std::size_t>(row)] = candidate;
  m_.particles[static_cast<std::size_t>(row)] = particle;
}

void Lockstep::set_rows(const ConstMatrixView& Theta, const Numbering& candidates) {
  m_.Theta = Theta;
  const auto period = static_cast<std::size_t>(candidates.period);
  for (std::size_t row = 0; row < m_.candidates.size(); ++row) {
    m_.candidates[row] = candidates.first + (period > 0 ? row % period : row);
    m_.particles[row] = 0;
  }
}

void Lockstep::start() {
  const bool random = (task_.start_std.array() > 0).any();
  if (random) draw(Purpose::simulated_start, 0);
  for (Index s = 0; s < m_.X.cols(); ++s) {
    m_.X.col(s).setConstant(task_.start_mean(s));
    if (random) m_.X.col(s) += task_.start_std(s) * m_.noise.col(s);
  }
}

void Lockstep::step(Index t, Episodes* record, TapedStep* tape) {
  const Matrix& seen = measured(t);
  const double time_s = static_cast<double>(t) * task_.dt_s;
  policy_.act(m_.Theta, seen, time_s, m_.U);
  actuators_.command(m_.X, m_.U);
  if (tape) {
    tape->seen = seen;
    move(t, *tape);
    step_slopes(task_, {m_.X, m_.U, m_.next, m_.U_before, time_s}, tape->earned_by);
  } else {
    move(t);
  }
  task_.reward(m_.X, m_.U, m_.next, m_.reward);
  if (task_.cost) {
    task_.cost({m_.X, m_.U, m_.next, m_.U_before, time_s}, m_.cost);
    m_.reward -= m_.cost;
  }
  for (Index l = 0; l < m_.holds.cols(); ++l)
    task_.limits[static_cast<std::size_t>(l)].holds({m_.X, m_.U, m_.next, m_.U_before, time_s}, m_.holds.col(l));
  if (remembers_actions()) m_.U_before = m_.U;
  if (task_.ended) task_.ended(m_.next, m_.ended);
  if (record) write(t, *record);
  if (tape) tape->earned = m_.alive;
  for (Index row = 0; row < m_.X.rows(); ++row) {
    if (tape && !finite(row)) tape->earned[static_cast<std::size_t>(row)] = false;
    settle(row, t);
  }
  if (tape) tape->went_on = m_.alive;
  m_.X.swap(m_.next);
}

bool Lockstep::drop_ended() {
  const Index rows = m_.X.rows(), alive_rows = std::ranges::count_if(m_.alive, [](char is) { return is != 0; });
  if (8 * (rows - alive_rows) < rows) return true;
  m_.alive_rows.clear();
  for (Index row = 0; row < rows; ++row)
    if (alive(row)) m_.alive_rows.push_back(row);
  const auto keep = [&](Matrix& of_rows) {
    m_.kept = of_rows(m_.alive_rows, Eigen::all);
    of_rows.swap(m_.kept);
  };
  keep(m_.Theta), keep(m_.X);
  if (remembers_actions()) keep(m_.U_before);
  for (std::size_t to = 0; to < m_.alive_rows.size(); ++to) {
    const auto from = static_cast<std::size_t>(m_.alive_rows[to]);
    m_.candidates[to] = m_.candidates[from], m_.particles[to] = m_.particles[from], m_.places[to] = m_.places[from];
  }
  resize(alive_rows);
  return alive_rows > 0;
}

/// The states that the policy sees, with measurement noise.
const Matrix& Lockstep::measured(Index t) {
  const Vector& std = model_.measurement_std();
  if (std.size() == 0 || options_.measurement_noise == 0) return m_.X;
  draw(Purpose::simulated_measurement, t);
  m_.seen = m_.X + m_.noise * (options_.measurement_noise * std).asDiagonal();
  return m_.seen;
}

/// Fills `noise` for step t.
void Lockstep::draw(Purpose purpose, Index t) {
  key_.purpose = purpose;
  fill_normals(key_, m_.candidates.data(), m_.particles.data(), static_cast<std::uint64_t>(t), m_.noise);
}

void Lockstep::draw_noise(Index t) {
  draw(Purpose::simulated_noise, t);
  if (options_.noise_clip > 0) m_.noise = m_.noise.cwiseMin(options_.noise_clip).cwiseMax(-options_.noise_clip);
  if (options_.deviations != 1) m_.noise *= options_.deviations;
}

void Lockstep::move(Index t) {
  if (uncertain()) {
    draw_noise(t);
    model_.sample(m_.X, m_.U, m_.noise, m_.next);
  } else {
    model_.predict_mean(m_.X, m_.U, m_.next);
  }
  m_.next += m_.X;
}

/// The same; with x′ = x + mean + ε √variance, ∂x′ = ∂x + ∂mean + ε ∂variance / (2 √variance).
void Lockstep::move(Index t, TapedStep& tape) {
  dynamics::Linearised& at = m_.linearised;
  model_.linearise(m_.X, m_.U, at);
  const Index dx = m_.X.cols(), inputs = dx + m_.U.cols();
  tape.next_by = at.mean_by;
  m_.next = at.mean;
  if (uncertain()) {
    draw_noise(t);
    m_.next.array() += m_.noise.array() * at.variance.array().sqrt();
    for (Index i = 0; i < dx; ++i) {
      const auto variance = at.variance.col(i).array();
      m_.factor = (variance > 0).select(0.5 * m_.noise.col(i).array() / variance.sqrt(), 0.0);
      for (Index j = i * inputs; j < (i + 1) * inputs; ++j)
        tape.next_by.col(j).array() += m_.factor.array() * at.variance_by.col(j).array();
    }
  }
  for (Index i = 0; i < dx; ++i) tape.next_by.col(i * inputs + i).array() += 1;
  m_.next += m_.X;
}

void Lockstep::write(Index t, Episodes& record) {
  const auto step = static_cast<std::size_t>(t);
  for (Index row = 0; row < m_.X.rows(); ++row) {
    if (!alive(row)) continue;
    const Index place = m_.places[static_cast<std::size_t>(row)];
    const auto i = static_cast<std::size_t>(place);
    record.actions[step].row(place) = m_.U.row(row);
    record.states[step + 1].row(place) = m_.next.row(row);
    record.rewards(place, t) = m_.reward(row);
    record.failed[i] = !finite(row);
    record.steps[i] += !record.failed[i];
    record.ended[i] = !record.failed[i] && (breaks(row) || ended(row));
  }
}

bool Lockstep::finite(Index row) const { return m_.next.row(row).allFinite() && std::isfinite(m_.reward(row)); }

/// Adds the reward, or ends the rollout. A row that has ended stays at the start, where the model is finite.
void Lockstep::settle(Index row, Index t) {
  auto& alive = m_.alive[static_cast<std::size_t>(row)];
  if (alive) {
    const Index place = m_.places[static_cast<std::size_t>(row)];
    const auto remaining = static_cast<double>(task_.horizon - t);
    const bool went_on = finite(row);
    const double left = remaining / static_cast<double>(task_.horizon);
    m_.returns(place) += went_on ? m_.reward(row) : remaining * task_.reward_floor;
    failed_ += !went_on;
    alive = went_on;
    if (!went_on) m_.broken.row(place).setConstant(left);  // what cannot be simulated cannot be judged
    if (went_on && (breaks(row) || ended(row))) {
      m_.broken.row(place) = (m_.holds.row(row).array().abs() > 0).select(m_.broken.row(place), left);
      m_.returns(place) += (remaining - 1) * task_.reward_floor;
      alive = false;
    }
  }
  if (!alive) m_.next.row(row) = task_.start_mean.transpose();
}

bool Lockstep::breaks(Index row) const { return !(m_.holds.row(row).array().abs() > 0).all(); }

}  // namespace rehearse::rollout
