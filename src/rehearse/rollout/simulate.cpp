#include "rehearse/rollout/simulate.hpp"

#include <algorithm>

#include "rehearse/rollout/lockstep.hpp"

namespace rehearse::rollout {
namespace {

/// Each chunk reads the whole model at every step, which on a busy machine costs more than using it, so many rows; but
/// so few that a late generation's candidates still occupy several threads.
Index usual_rows(Index batch) { return batch >= 512 ? 64 : 32; }

LockstepMemory& memory_of_this_thread() {
  thread_local LockstepMemory memory;
  return memory;
}

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

/// All steps of a chunk from its start, and its returns.
const Vector& run_steps(Lockstep& chunk, const Task& task, const Evaluator& evaluator, Episodes* record) {
  chunk.start();
  if (record) record->begin(task, chunk.states());
  for (Index t = 0; t < task.horizon; ++t) {
    evaluator.stop_if_asked();
    chunk.step(t, record);
    if (!chunk.drop_ended()) break;
  }
  if (!record) return chunk.returns();
  record->finish(task, chunk.returns());
  return record->returns;
}

}  // namespace

Simulated simulate(const Simulation& simulation, const ConstMatrixView& Theta, const Candidates& candidates,
                   const Evaluator& evaluator) {
  const Index particles = candidates.particles;
  const Task& task = simulation.task;
  check_simulation(simulation, Theta.rows(), particles);
  const Index total = Theta.cols() * particles;
  const Index most = rows_of_chunk(total, usual_rows(total), rows_at_once(simulation.model, task));
  const Index chunks = (total + most - 1) / most;
  const auto limits = static_cast<Index>(task.limits.size());
  Matrix results((1 + limits) * most + 1, chunks);  // returns, limits one by one, and how many failed
  const auto task_of_chunk = [&](Index c) {
    VectorView result = results.col(c);
    const Index first = c * most, rows = std::min(most, total - first);
    Lockstep chunk(simulation, rows, memory_of_this_thread());
    for (Index row = 0; row < rows; ++row) {
      const Index candidate = (first + row) / particles, particle = (first + row) % particles;
      chunk.set_row(row, Theta.col(candidate), candidates.first + static_cast<std::uint64_t>(candidate),
                    static_cast<std::uint64_t>(particle));
    }
    thread_local Episodes episodes;
    result.head(rows) = run_steps(chunk, task, evaluator, task.episode_reward ? &episodes : nullptr);
    for (Index l = 0; l < limits; ++l) result.segment((1 + l) * most, rows) = chunk.broken().col(l);
    result(result.size() - 1) = static_cast<double>(chunk.failed());
  };
  evaluator.for_each(chunks, task_of_chunk);
  return gathered(results, limits, particles, Theta.cols());
}

Recorded simulate_recorded(const Simulation& simulation, const Vector& theta, Index particles,
                           const Evaluator& evaluator) {
  check_simulation(simulation, theta.size(), particles);
  const Task& task = simulation.task;
  LockstepMemory memory;
  Lockstep chunk(simulation, particles, memory);
  for (Index p = 0; p < particles; ++p) chunk.set_row(p, theta, 0, static_cast<std::uint64_t>(p));
  chunk.start();
  Recorded recorded{.rewards = Matrix(particles, task.horizon)};
  recorded.states.push_back(chunk.states());
  Episodes episodes;
  episodes.begin(task, chunk.states());
  for (Index t = 0; t < task.horizon; ++t) {
    evaluator.stop_if_asked();
    const Vector before = chunk.returns();
    chunk.step(t, &episodes);
    recorded.rewards.col(t) = chunk.returns() - before;
    recorded.states.push_back(chunk.states());
    for (Index p = 0; p < particles; ++p)
      if (!chunk.alive(p)) recorded.states.back().row(p).setConstant(kNaN);
  }
  episodes.finish(task, chunk.returns());
  recorded.returns = episodes.returns;
  return recorded;
}

void simulate_episodes(const Simulation& simulation, const ConstMatrixView& Theta, const Numbering& candidates,
                       Episodes& episodes, const Evaluator& evaluator) {
  check_simulation(simulation, Theta.cols(), 1);
  Lockstep chunk(simulation, Theta.rows(), memory_of_this_thread());
  chunk.set_rows(Theta, candidates);
  run_steps(chunk, simulation.task, evaluator, &episodes);
}

}  // namespace rehearse::rollout
