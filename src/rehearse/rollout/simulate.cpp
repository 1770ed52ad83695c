#include "rehearse/rollout/simulate.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::rollout {
namespace {

/// Rows of a chunk, by the size of the batch alone: each chunk reads the whole model at every step, which on a busy
/// machine costs more than using it, so many; but so few that a late generation's candidates still occupy several
/// threads. Whoever is dear to call is called twice a step, for two threads, unless a quarter of the rows that make up
/// for a call are all there are.
Index rows_of_chunk(Index batch, Index rows_at_once) {
  const Index usual = batch >= 512 ? 64 : 32;
  return std::min(batch, std::max(usual, std::min(rows_at_once, std::max((batch + 1) / 2, rows_at_once / 4))));
}

/// Memory of a chunk, kept by each thread from one to the next: fresh pages cost more than a step of a cheap model.
struct Buffers {
  Matrix Theta, X, seen, next, noise, U, U_before;
  Matrix holds, broken;  // rows × limits
  Vector reward, cost, returns, ended;
  std::vector<std::uint64_t> candidates, particles;
  std::vector<char> alive;
};

Buffers& buffers_of_this_thread() {
  thread_local Buffers buffers;
  return buffers;
}

/// Some rows of a batch in lockstep, each a particle of a candidate.
class Chunk {
 public:
  Chunk(const Simulation& of, Index rows, Buffers& buffers)
      : model_(of.model), policy_(of.policy), task_(of.task), key_(of.key), options_(of.options), b_(buffers) {
    b_.Theta.resize(rows, policy_.parameters());
    for (Matrix* states : {&b_.X, &b_.seen, &b_.next, &b_.noise}) states->resize(rows, task_.state_size());
    b_.U.resize(rows, task_.action_size());
    b_.reward.resize(rows);
    if (task_.cost) {
      b_.U_before.setZero(rows, task_.action_size());
      b_.cost.resize(rows);
    }
    b_.holds.resize(rows, static_cast<Index>(task_.limits.size()));
    b_.broken.setZero(rows, b_.holds.cols());
    b_.ended.setZero(rows);
    b_.returns.setZero(rows);
    b_.candidates.resize(static_cast<std::size_t>(rows));
    b_.particles.resize(static_cast<std::size_t>(rows));
    b_.alive.assign(static_cast<std::size_t>(rows), true);
  }

  void set_row(Index row, const ConstVectorView& theta, std::uint64_t candidate, std::uint64_t particle) {
    b_.Theta.row(row) = theta.transpose();
    b_.candidates[static_cast<std::size_t>(row)] = candidate;
    b_.particles[static_cast<std::size_t>(row)] = particle;
  }

  void set_rows(const ConstMatrixView& Theta, std::uint64_t first_candidate) {
    b_.Theta = Theta;
    for (std::size_t row = 0; row < b_.candidates.size(); ++row) {
      b_.candidates[row] = first_candidate + row;
      b_.particles[row] = 0;
    }
  }

  void start() {
    const bool random = (task_.start_std.array() > 0).any();
    if (random) draw(Purpose::simulated_start, 0);
    for (Index s = 0; s < b_.X.cols(); ++s) {
      b_.X.col(s).setConstant(task_.start_mean(s));
      if (random) b_.X.col(s) += task_.start_std(s) * b_.noise.col(s);
    }
  }

  /// x_t → x_{t+1} for every row; what happens is recorded, if it is to be.
  void step(Index t, Episodes* record = nullptr) {
    policy_.act(b_.Theta, measured(t), static_cast<double>(t) * task_.dt_s, b_.U);
    actuators_.command(b_.X, b_.U);
    if (options_.sample && !model_.certain())
      sample(t);
    else
      model_.predict_mean(b_.X, b_.U, b_.next);
    b_.next += b_.X;
    task_.reward(b_.X, b_.U, b_.next, b_.reward);
    if (task_.cost) charge(t);
    for (Index l = 0; l < b_.holds.cols(); ++l)
      task_.limits[static_cast<std::size_t>(l)].holds(b_.X, b_.U, b_.next, b_.holds.col(l));
    if (task_.ended) task_.ended(b_.next, b_.ended);
    if (record) write(t, *record);
    for (Index row = 0; row < b_.X.rows(); ++row) settle(row, t);
    b_.X.swap(b_.next);
  }

  const Matrix& states() const { return b_.X; }
  const Vector& returns() const { return b_.returns; }
  const Matrix& broken() const { return b_.broken; }
  bool alive(Index row) const { return b_.alive[static_cast<std::size_t>(row)] != 0; }
  Index failed() const { return failed_; }

 private:
  /// What the policy sees.
  const Matrix& measured(Index t) {
    const Vector& std = model_.measurement_std();
    if (std.size() == 0 || options_.measurement_noise == 0) return b_.X;
    draw(Purpose::simulated_measurement, t);
    b_.seen = b_.X + b_.noise * (options_.measurement_noise * std).asDiagonal();
    return b_.seen;
  }

  /// Fills `noise` for step t.
  void draw(Purpose purpose, Index t) {
    key_.purpose = purpose;
    fill_normals(key_, b_.candidates.data(), b_.particles.data(), static_cast<std::uint64_t>(t), b_.noise);
  }

  void sample(Index t) {
    draw(Purpose::simulated_noise, t);
    if (options_.noise_clip > 0) b_.noise = b_.noise.cwiseMin(options_.noise_clip).cwiseMax(-options_.noise_clip);
    model_.sample(b_.X, b_.U, b_.noise, b_.next);
  }

  void write(Index t, Episodes& record) {
    record.actions[static_cast<std::size_t>(t)] = b_.U;
    record.states[static_cast<std::size_t>(t + 1)] = b_.next;
    record.rewards.col(t) = b_.reward;
    for (Index row = 0; row < b_.X.rows(); ++row) {
      if (!alive(row)) continue;
      const auto i = static_cast<std::size_t>(row);
      record.failed[i] = !finite(row);
      record.steps[i] += !record.failed[i];
      record.ended[i] = !record.failed[i] && (breaks(row) || ended(row));
    }
  }

  void charge(Index t) {
    task_.cost({b_.X, b_.U, b_.next, b_.U_before, static_cast<double>(t) * task_.dt_s}, b_.cost);
    b_.reward -= b_.cost;
    b_.U_before = b_.U;
  }

  bool finite(Index row) const { return b_.next.row(row).allFinite() && std::isfinite(b_.reward(row)); }

  /// Adds the reward, or ends the rollout. A row that has ended stays at the start, where the model is finite.
  void settle(Index row, Index t) {
    auto& alive = b_.alive[static_cast<std::size_t>(row)];
    if (alive) {
      const auto remaining = static_cast<double>(task_.horizon - t);
      const bool went_on = finite(row);
      b_.returns(row) += went_on ? b_.reward(row) : remaining * task_.reward_floor;
      failed_ += !went_on;
      alive = went_on;
      if (went_on && (breaks(row) || ended(row))) {
        const double left = remaining / static_cast<double>(task_.horizon);
        b_.broken.row(row) = (b_.holds.row(row).array().abs() > 0).select(b_.broken.row(row), left);
        b_.returns(row) += (remaining - 1) * task_.reward_floor;
        alive = false;
      }
    }
    if (!alive) b_.next.row(row) = task_.start_mean.transpose();
  }

  bool breaks(Index row) const { return !(b_.holds.row(row).array().abs() > 0).all(); }
  bool ended(Index row) const { return is_true(b_.ended(row)); }

  const dynamics::DynamicsModel& model_;
  const policy::Policy& policy_;
  const Task& task_;
  Actuators actuators_ = task_.actuators();
  StreamKey key_;
  SimulateOptions options_;
  Buffers& b_;
  Index failed_ = 0;
};

/// The result of all chunks, each of which has filled a column.
Simulated gathered(const Matrix& results, Index limits, Index particles, Index candidates) {
  const Index total = particles * candidates, most = (results.rows() - 1) / (1 + limits);
  Simulated simulated{.returns = Matrix(particles, candidates)};
  simulated.broken.assign(static_cast<std::size_t>(limits), Matrix(particles, candidates));
  for (Index c = 0; c < results.cols(); ++c) {
    const Index rows = std::min(most, total - c * most);
    Vector::Map(simulated.returns.data() + c * most, rows) = results.col(c).head(rows);
    for (Index l = 0; l < limits; ++l)
      Vector::Map(simulated.broken[static_cast<std::size_t>(l)].data() + c * most, rows) =
          results.col(c).segment((1 + l) * most, rows);
    simulated.failed += static_cast<Index>(results(results.rows() - 1, c));
  }
  return simulated;
}

/// parameters: of one θ.
void check(const Simulation& simulation, Index parameters, Index particles) {
  const policy::Policy& policy = simulation.policy;
  const Task& task = simulation.task;
  if (parameters == policy.parameters() && policy.actions() == task.action_size() && particles >= 1) return;
  throw InvalidInput(
      fmt::format("theta has {} numbers for the {} of the policy '{}', which has {} actions for the {} of the task; "
                  "particles = {}, must be ≥ 1",
                  parameters, policy.parameters(), policy.name(), policy.actions(), task.action_size(), particles));
}

}  // namespace

Simulated simulate(const Simulation& simulation, const ConstMatrixView& Theta, const Candidates& candidates,
                   const Evaluator& evaluator) {
  const auto& [first_candidate, particles] = candidates;
  const Index horizon = simulation.task.horizon;
  check(simulation, Theta.rows(), particles);
  const Index total = Theta.cols() * particles;
  const Index most = rows_of_chunk(total, std::max(simulation.model.rows_at_once(), simulation.task.rows_at_once));
  const Index chunks = (total + most - 1) / most;
  const auto limits = static_cast<Index>(simulation.task.limits.size());
  Matrix results((1 + limits) * most + 1, chunks);  // returns, limits one by one, and how many failed
  const auto task_of_chunk = [&](Index c) {
    VectorView result = results.col(c);
    const Index first = c * most, rows = std::min(most, total - first);
    Chunk chunk(simulation, rows, buffers_of_this_thread());
    for (Index row = 0; row < rows; ++row) {
      const Index candidate = (first + row) / particles, particle = (first + row) % particles;
      chunk.set_row(row, Theta.col(candidate), first_candidate + static_cast<std::uint64_t>(candidate),
                    static_cast<std::uint64_t>(particle));
    }
    chunk.start();
    for (Index t = 0; t < horizon; ++t) {
      evaluator.stop_if_asked();
      chunk.step(t);
    }
    result.head(rows) = chunk.returns();
    for (Index l = 0; l < limits; ++l) result.segment((1 + l) * most, rows) = chunk.broken().col(l);
    result(result.size() - 1) = static_cast<double>(chunk.failed());
  };
  evaluator.for_each(chunks, task_of_chunk);
  return gathered(results, limits, particles, Theta.cols());
}

Recorded simulate_recorded(const Simulation& simulation, const Vector& theta, Index particles) {
  check(simulation, theta.size(), particles);
  const Index horizon = simulation.task.horizon;
  Buffers buffers;
  Chunk chunk(simulation, particles, buffers);
  for (Index p = 0; p < particles; ++p) chunk.set_row(p, theta, 0, static_cast<std::uint64_t>(p));
  chunk.start();
  Recorded recorded{.rewards = Matrix(particles, horizon)};
  recorded.states.push_back(chunk.states());
  for (Index t = 0; t < horizon; ++t) {
    const Vector before = chunk.returns();
    chunk.step(t);
    recorded.rewards.col(t) = chunk.returns() - before;
    recorded.states.push_back(chunk.states());
    for (Index p = 0; p < particles; ++p)
      if (!chunk.alive(p)) recorded.states.back().row(p).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  recorded.returns = chunk.returns();
  return recorded;
}

void simulate_episodes(const Simulation& simulation, const ConstMatrixView& Theta, std::uint64_t first_candidate,
                       Episodes& episodes) {
  check(simulation, Theta.cols(), 1);
  const Index rows = Theta.rows(), T = simulation.task.horizon;
  episodes.states.resize(static_cast<std::size_t>(T + 1));
  episodes.actions.resize(static_cast<std::size_t>(T));
  episodes.rewards.resize(rows, T);
  episodes.reward_floor = simulation.task.reward_floor;
  episodes.steps.assign(static_cast<std::size_t>(rows), 0);
  episodes.ended.assign(static_cast<std::size_t>(rows), false);
  episodes.failed.assign(static_cast<std::size_t>(rows), false);
  Chunk chunk(simulation, rows, buffers_of_this_thread());
  chunk.set_rows(Theta, first_candidate);
  chunk.start();
  episodes.states.front() = chunk.states();
  for (Index t = 0; t < T; ++t) chunk.step(t, &episodes);
  episodes.returns = chunk.returns();
}

void Episodes::copy(Index row, Episode& episode) const {
  const auto i = static_cast<std::size_t>(row);
  const Index T = steps[i];
  episode.states.resize(T + 1, states.front().cols());
  episode.actions.resize(T, actions.front().cols());
  for (Index t = 0; t <= T; ++t) episode.states.row(t) = states[static_cast<std::size_t>(t)].row(row);
  for (Index t = 0; t < T; ++t) episode.actions.row(t) = actions[static_cast<std::size_t>(t)].row(row);
  episode.true_states = episode.states;
  episode.rewards = rewards.row(row).head(T).transpose();
  episode.charged = static_cast<double>(rewards.cols() - T) * reward_floor;
  episode.ended = ended[i];
}

}  // namespace rehearse::rollout
