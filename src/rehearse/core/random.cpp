#include "rehearse/core/random.hpp"

#include <atomic>
#include <cmath>
#include <numbers>
#include <utility>

#include <Random123/philox.h>
#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/vector_math.hpp"

namespace rehearse {
namespace {

using Philox = r123::Philox4x64;

constexpr std::uint64_t kNoStep = ~std::uint64_t{0};

std::atomic<const StreamObserver*> observer{nullptr};

void check_width(std::uint64_t value, unsigned bits, const char* name) {
  if (value >> bits != 0)
    throw InvalidInput(fmt::format("random stream: {} = {}, must be below 2^{}", name, value, bits));
}

/// Seeds keep a word to themselves.
std::array<std::uint64_t, 2> key_of(const StreamKey& key) {
  check_width(key.trial, 32, "trial");
  check_width(key.search, 16, "search");
  static_assert(sizeof(Phase) == 1 && sizeof(Stage) == 1 && sizeof(Purpose) == 1);
  const auto phase_and_stage = static_cast<std::uint64_t>(key.phase) << 4 | static_cast<std::uint64_t>(key.stage);
  return {key.seed,
          key.trial << 32 | key.search << 16 | phase_and_stage << 8 | static_cast<std::uint64_t>(key.purpose)};
}

/// The first word of the counter: blocks of numbers count in its lower half.
std::uint64_t counter_of(const StreamKey& key) {
  check_width(key.descent, 32, "descent");
  return key.descent << 32;
}

void observe(StreamKey key, std::optional<std::uint64_t> step) {
  if (const StreamObserver* told = observer.load(std::memory_order_relaxed)) (*told)(key, step);
}

std::array<std::uint64_t, 4> block_of(const std::array<std::uint64_t, 2>& key,
                                      const std::array<std::uint64_t, 4>& counter) {
  const Philox::ctr_type out = Philox{}({{counter[0], counter[1], counter[2], counter[3]}}, {{key[0], key[1]}});
  return {out[0], out[1], out[2], out[3]};
}

void observe_rows(StreamKey key, const std::uint64_t* candidates, const std::uint64_t* particles, std::uint64_t step,
                  Index rows) {
  for (Index i = 0; i < rows; ++i) {
    key.candidate = candidates[i];
    key.particle = particles[i];
    observe(key, step);
  }
}

double to_uniform(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1.0p-53; }

}  // namespace

Rng::Rng(const StreamKey& key) : key_(key_of(key)), counter_{counter_of(key), kNoStep, key.particle, key.candidate} {
  observe(key, {});
}

std::uint64_t Rng::operator()() {
  if (used_ == block_.size()) {
    block_ = block_of(key_, counter_);
    ++counter_[0];
    used_ = 0;
  }
  return block_[used_++];
}

double Rng::uniform() { return to_uniform((*this)()); }

double Rng::uniform(double low, double high) { return low + (high - low) * uniform(); }

double Rng::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_normal_;
  }
  const double radius = std::sqrt(-2 * std::log(1 - uniform()));
  const double angle = 2 * std::numbers::pi * uniform();
  spare_normal_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

Index Rng::below(Index n) { return static_cast<Index>(uniform() * static_cast<double>(n)); }

void fill_normals(const StreamKey& stream, const std::uint64_t* candidates, const std::uint64_t* particles,
                  std::uint64_t step, MatrixView normals) {
  const auto key = key_of(stream);
  const std::uint64_t first_block = counter_of(stream);
  if (observer.load(std::memory_order_relaxed)) observe_rows(stream, candidates, particles, step, normals.rows());
  const Index rows = normals.rows(), columns = normals.cols();
  thread_local Matrix uniforms;
  const Index blocks = (columns + 3) / 4;
  if (uniforms.rows() != rows || uniforms.cols() < 4 * blocks) uniforms.resize(rows, 4 * blocks);
  for (Index i = 0; i < rows; ++i)
    for (Index b = 0; b < blocks; ++b) {
      const auto bits = block_of(key, {first_block + static_cast<std::uint64_t>(b), step, particles[i], candidates[i]});
      for (Index k = 0; k < 4; ++k) uniforms(i, 4 * b + k) = to_uniform(bits[static_cast<std::size_t>(k)]);
    }
  for (Index c = 0; c < columns; c += 2) {  // columns 2j and 2j+1 of `uniforms` make columns 2j and 2j+1 of `normals`
    double* second = c + 1 < columns ? normals.col(c + 1).data() : nullptr;
    box_muller(uniforms.col(c).data(), uniforms.col(c + 1).data(), normals.col(c).data(), second, rows);
  }
}

ObservedStreams::ObservedStreams(StreamObserver told) : observer_(std::move(told)) { observer = &observer_; }

ObservedStreams::~ObservedStreams() { observer = nullptr; }

}  // namespace rehearse
