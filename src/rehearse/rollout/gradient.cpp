#include "rehearse/rollout/gradient.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/policy/differentiable.hpp"
#include "rehearse/rollout/lockstep.hpp"

namespace rehearse::rollout {
namespace {

constexpr Index kMostRows = 64;  // of a chunk, which are particles of one candidate

/// Memory of a chunk and its way back, kept by each thread.
struct TapeMemory {
  LockstepMemory chunk;
  std::vector<TapedStep> tape;
  Matrix by_reached, by_state, by_seen, by_action, by_action_before;
};

/// Derivatives of the returns of a chunk's rows, step by step from the last to the first.
class WayBack {
 public:
  WayBack(const Simulation& of, const policy::Differentiable& policy, Index rows, TapeMemory& memory)
      : policy_(policy), dx_(of.task.state_size()), du_(of.task.action_size()), cost_(of.task.cost), m_(memory) {
    m_.by_reached.setZero(rows, dx_);
    m_.by_action_before.setZero(rows, du_);
    m_.by_seen.resize(rows, dx_);
  }

  /// Adds to by_theta what the actions of this step count.
  void step(const TapedStep& step, const ConstVectorView& theta, VectorView by_theta) {
    leave_out(step.went_on, m_.by_reached);
    leave_out(step.went_on, m_.by_action_before);
    const auto earned_by_reached = step.earned_by.middleCols(dx_ + du_, dx_);
    m_.by_reached += earned_by_reached;
    m_.by_state = step.earned_by.leftCols(dx_);
    m_.by_action = step.earned_by.middleCols(dx_, du_) + m_.by_action_before;
    for (Index i = 0; i < dx_; ++i) {
      const auto by = m_.by_reached.col(i).array();
      const Index first = i * (dx_ + du_);
      for (Index j = 0; j < dx_; ++j) m_.by_state.col(j).array() += by * step.next_by.col(first + j).array();
      for (Index j = 0; j < du_; ++j) m_.by_action.col(j).array() += by * step.next_by.col(first + dx_ + j).array();
    }
    if (cost_) m_.by_action_before = step.earned_by.rightCols(du_);
    for (Matrix* by : {&m_.by_state, &m_.by_action, &m_.by_action_before}) leave_out(step.earned, *by);
    policy_.pull_back(theta, step.seen, m_.by_action, m_.by_seen, by_theta);
    m_.by_reached = m_.by_state + m_.by_seen;
  }

 private:
  /// Rows that did not earn count nothing; nor do those whose derivatives are beyond all numbers.
  static void leave_out(const std::vector<char>& counts, Matrix& by) {
    for (Index row = 0; row < by.rows(); ++row)
      if (!counts[static_cast<std::size_t>(row)] || !by.row(row).allFinite()) by.row(row).setZero();
  }

  const policy::Differentiable& policy_;
  Index dx_, du_;
  bool cost_;
  TapeMemory& m_;
};

/// The rollouts of a chunk.
struct StreamRows {
  std::uint64_t candidate, first_particle;
  Index rows;
};

/// Runs a chunk. result: the sum of returns, the number of failed rollouts, and the sum of gradients.
void run(const Simulation& simulation, const policy::Differentiable& policy, const ConstVectorView& theta,
         const StreamRows& of, const Evaluator& evaluator, VectorView result) {
  thread_local TapeMemory memory;
  const Index T = simulation.task.horizon;
  memory.tape.resize(static_cast<std::size_t>(T));
  Lockstep chunk(simulation, of.rows, memory.chunk);
  for (Index row = 0; row < of.rows; ++row)
    chunk.set_row(row, theta, of.candidate, of.first_particle + static_cast<std::uint64_t>(row));
  chunk.start();
  for (Index t = 0; t < T; ++t) {
    evaluator.stop_if_asked();
    chunk.step(t, nullptr, &memory.tape[static_cast<std::size_t>(t)]);
  }
  WayBack back(simulation, policy, of.rows, memory);
  result.setZero();
  for (Index t = T; t-- > 0;) back.step(memory.tape[static_cast<std::size_t>(t)], theta, result.tail(theta.size()));
  result(0) = chunk.returns().sum();
  result(1) = static_cast<double>(chunk.failed());
}

const policy::Differentiable& differentiable(const policy::Policy& policy) {
  const auto* known = dynamic_cast<const policy::Differentiable*>(&policy);
  if (!known) throw InvalidInput(fmt::format("the policy '{}' does not know its derivatives", policy.name()));
  return *known;
}

}  // namespace

ReturnGradients return_gradients(const Simulation& simulation, const ConstMatrixView& Theta,
                                 const Candidates& candidates, const Evaluator& evaluator) {
  const policy::Differentiable& policy = differentiable(simulation.policy);
  check_simulation(simulation, Theta.rows(), candidates.particles);
  const Index particles = candidates.particles, chunks = (particles + kMostRows - 1) / kMostRows;
  const Index most = (particles + chunks - 1) / chunks;
  Matrix results(2 + Theta.rows(), chunks * Theta.cols());
  evaluator.for_each(results.cols(), [&](Index c) {
    const Index candidate = c / chunks, first = c % chunks * most;
    run(simulation, policy, Theta.col(candidate),
        {.candidate = candidates.first + static_cast<std::uint64_t>(candidate),
         .first_particle = static_cast<std::uint64_t>(first),
         .rows = std::min(most, particles - first)},
        evaluator, results.col(c));
  });
  ReturnGradients all{Vector::Zero(Theta.cols()), Matrix::Zero(Theta.rows(), Theta.cols())};
  for (Index c = 0; c < results.cols(); ++c) {
    const double share = 1 / static_cast<double>(particles);
    all.returns(c / chunks) += share * results(0, c);
    all.failed += static_cast<Index>(results(1, c));
    all.by_theta.col(c / chunks) += share * results.col(c).tail(Theta.rows());
  }
  return all;
}

}  // namespace rehearse::rollout
