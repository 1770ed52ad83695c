#include "rehearse/rollout/imagine.hpp"

#include <algorithm>
#include <limits>

namespace rehearse::rollout {
namespace {

// Fixed, so that results do not depend on the number of threads; small, so that the few candidates of a late generation
// still occupy several threads.
constexpr Index kChunk = 32;  // rows

/// Memory of a chunk, kept by each thread from one to the next: fresh pages cost more than a step of a cheap model.
struct Buffers {
  Matrix Theta, X, next, variance, noise, U;
  Vector reward, returns;
};

Buffers& buffers_of_this_thread() {
  thread_local Buffers buffers;
  return buffers;
}

/// The rollouts [first, first + rows) of a batch; rollout r is particle r % particles of candidate r / particles.
class Chunk {
 public:
  Chunk(const dynamics::DynamicsModel& model, const policy::Policy& policy, const Task& task, const StreamKey& key,
        const ImagineOptions& options, Index rows, Buffers& buffers)
      : model_(model),
        policy_(policy),
        task_(task),
        key_(key),
        options_(options),
        candidates_(static_cast<std::size_t>(rows)),
        particles_(static_cast<std::size_t>(rows)),
        alive_(static_cast<std::size_t>(rows), true),
        Theta_(buffers.Theta),
        X_(buffers.X),
        next_(buffers.next),
        variance_(buffers.variance),
        noise_(buffers.noise),
        U_(buffers.U),
        reward_(buffers.reward),
        returns_(buffers.returns) {
    Theta_.resize(rows, policy.parameters());
    for (Matrix* states : {&X_, &next_, &variance_, &noise_}) states->resize(rows, task.state_size());
    U_.resize(rows, task.action_size());
    reward_.resize(rows);
    returns_.setZero(rows);
  }

  void set_row(Index row, const ConstVectorView& theta, std::uint64_t candidate, std::uint64_t particle) {
    Theta_.row(row) = theta.transpose();
    candidates_[static_cast<std::size_t>(row)] = options_.common_random_numbers ? 0 : candidate;
    particles_[static_cast<std::size_t>(row)] = particle;
  }

  void start() {
    StreamKey key = key_;
    key.purpose = Purpose::imagined_start;
    const bool random = (task_.start_std.array() > 0).any();
    if (random) fill_normals(key, candidates_.data(), particles_.data(), 0, noise_);
    for (Index s = 0; s < X_.cols(); ++s) {
      X_.col(s).setConstant(task_.start_mean(s));
      if (random) X_.col(s) += task_.start_std(s) * noise_.col(s);
    }
  }

  /// x_t → x_{t+1} for every row.
  void step(Index t) {
    policy_.act(Theta_, X_, static_cast<double>(t) * task_.dt_s, U_);
    model_.predict(X_, U_, next_, variance_);
    if (options_.sample) add_noise(t);
    next_ += X_;
    task_.reward(X_, U_, next_, reward_);
    for (Index row = 0; row < X_.rows(); ++row) settle(row, t);
    X_.swap(next_);
  }

  const Matrix& states() const { return X_; }
  const Vector& returns() const { return returns_; }
  bool alive(Index row) const { return alive_[static_cast<std::size_t>(row)] != 0; }
  Index failed() const { return failed_; }

 private:
  void add_noise(Index t) {
    if (!(variance_.array() > 0).any()) return;
    fill_normals(key_, candidates_.data(), particles_.data(), static_cast<std::uint64_t>(t), noise_);
    if (options_.noise_clip > 0) noise_ = noise_.cwiseMin(options_.noise_clip).cwiseMax(-options_.noise_clip);
    next_.array() += noise_.array() * variance_.array().sqrt();
  }

  /// Adds the reward, or ends the rollout. A row that has ended stays at the start, where the model is finite.
  void settle(Index row, Index t) {
    auto& alive = alive_[static_cast<std::size_t>(row)];
    if (alive) {
      const auto remaining = static_cast<double>(task_.horizon - t);
      const bool finite = next_.row(row).allFinite() && std::isfinite(reward_(row));
      returns_(row) += finite ? reward_(row) : remaining * task_.reward_floor;
      failed_ += !finite;
      alive = finite;
      if (finite && task_.ended && task_.ended(next_.row(row).transpose())) {
        returns_(row) += (remaining - 1) * task_.reward_floor;
        alive = false;
      }
    }
    if (!alive) next_.row(row) = task_.start_mean.transpose();
  }

  const dynamics::DynamicsModel& model_;
  const policy::Policy& policy_;
  const Task& task_;
  StreamKey key_;
  ImagineOptions options_;
  std::vector<std::uint64_t> candidates_, particles_;
  std::vector<char> alive_;
  Matrix &Theta_, &X_, &next_, &variance_, &noise_, &U_;
  Vector &reward_, &returns_;
  Index failed_ = 0;
};

}  // namespace

Imagined imagine(const dynamics::DynamicsModel& model, const policy::Policy& policy, const Task& task,
                 const ConstMatrixView& Theta, std::uint64_t first_candidate, Index particles, const StreamKey& key,
                 const ImagineOptions& options, const Evaluator& evaluator) {
  const Index total = Theta.cols() * particles;
  const Index chunks = (total + kChunk - 1) / kChunk;
  Matrix results(kChunk + 1, chunks);  // returns, and how many failed
  const auto task_of_chunk = [&](Index c, VectorView result) {
    const Index first = c * kChunk, rows = std::min(kChunk, total - first);
    Chunk chunk(model, policy, task, key, options, rows, buffers_of_this_thread());
    for (Index row = 0; row < rows; ++row) {
      const Index candidate = (first + row) / particles, particle = (first + row) % particles;
      chunk.set_row(row, Theta.col(candidate), first_candidate + static_cast<std::uint64_t>(candidate),
                    static_cast<std::uint64_t>(particle));
    }
    chunk.start();
    for (Index t = 0; t < task.horizon; ++t) chunk.step(t);
    result.head(rows) = chunk.returns();
    result(kChunk) = static_cast<double>(chunk.failed());
  };
  evaluator.evaluate(task_of_chunk, results);

  Imagined imagined{.returns = Matrix(particles, Theta.cols())};
  for (Index c = 0; c < chunks; ++c) {
    const Index rows = std::min(kChunk, total - c * kChunk);
    Vector::Map(imagined.returns.data() + c * kChunk, rows) = results.col(c).head(rows);
    imagined.failed += static_cast<Index>(results(kChunk, c));
  }
  return imagined;
}

Recorded imagine_recorded(const dynamics::DynamicsModel& model, const policy::Policy& policy, const Task& task,
                          const Vector& theta, Index particles, const StreamKey& key, const ImagineOptions& options) {
  Buffers buffers;
  Chunk chunk(model, policy, task, key, options, particles, buffers);
  for (Index p = 0; p < particles; ++p) chunk.set_row(p, theta, 0, static_cast<std::uint64_t>(p));
  chunk.start();
  Recorded recorded;
  recorded.states.push_back(chunk.states());
  for (Index t = 0; t < task.horizon; ++t) {
    chunk.step(t);
    recorded.states.push_back(chunk.states());
    for (Index p = 0; p < particles; ++p)
      if (!chunk.alive(p)) recorded.states.back().row(p).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  recorded.returns = chunk.returns();
  return recorded;
}

}  // namespace rehearse::rollout
