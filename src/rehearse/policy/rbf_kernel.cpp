#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/policy/rbf_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include <hwy/aligned_allocator.h>
#include <hwy/contrib/math/math-inl.h>

#include "rehearse/core/elementary-inl.hpp"
#include "rehearse/policy/rbf_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::policy {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;

/// Columns of vectors, one lane a row of the batch.
struct Lanes {
  Lanes(double* memory, Index count) : data(memory), lanes(count) {}
  HWY_INLINE V operator[](Index i) const { return hn::Load(D(), data + i * lanes); }
  HWY_INLINE void set(Index i, V value) const { hn::Store(value, D(), data + i * lanes); }

  double* data;
  Index lanes;
};

HWY_INLINE V clamp(V x, double limit) {
  const D d;
  return hn::Max(hn::Set(d, -limit), hn::Min(x, hn::Set(d, limit)));
}

/// exp(−½ squared)
HWY_INLINE V correlation(V squared) {
  const D d;
  return rehearse::HWY_NAMESPACE::keep_nan(squared, hn::Exp(d, hn::Mul(squared, hn::Set(d, -0.5))));
}

HWY_INLINE V squared_distance(const Lanes& points, Index a, Index b, Index inputs) {
  V sum = hn::Zero(D());
  for (Index i = 0; i < inputs; ++i) {
    const V difference = hn::Sub(points[a * inputs + i], points[b * inputs + i]);
    sum = hn::MulAdd(difference, difference, sum);
  }
  return sum;
}

/// Row i of a lower triangle, packed by rows.
constexpr Index row_of(Index i) { return i * (i + 1) / 2; }

/// K + σ_n² I = L Lᵀ, and in place of L's diagonal its reciprocal.
HWY_INLINE void factorise(const Lanes& points, const RbfShape& shape, const Lanes& L) {
  const D d;
  const V diagonal = hn::Set(d, 1 + shape.noise * shape.noise);
  for (Index i = 0; i < shape.centres; ++i)
    for (Index j = 0; j <= i; ++j) {
      V rest = i == j ? diagonal : correlation(squared_distance(points, i, j, shape.inputs));
      for (Index k = 0; k < j; ++k) rest = hn::NegMulAdd(L[row_of(i) + k], L[row_of(j) + k], rest);
      L.set(row_of(i) + j, i == j ? hn::Div(hn::Set(d, 1.0), hn::Sqrt(rest)) : hn::Mul(rest, L[row_of(j) + j]));
    }
}

/// b := L⁻¹ b
HWY_INLINE void solve(const Lanes& L, const Lanes& b, Index n) {
  for (Index i = 0; i < n; ++i) {
    V rest = b[i];
    for (Index k = 0; k < i; ++k) rest = hn::NegMulAdd(L[row_of(i) + k], b[k], rest);
    b.set(i, hn::Mul(rest, L[row_of(i) + i]));
  }
}

/// The memory of the vectors of a block of rows: first what all actions share, then each action's network.
struct Block {
  Block(const RbfShape& s, Index action, double* memory, Index lanes)
      : x(memory, lanes),
        k(x.data + s.inputs * lanes, lanes),
        theta(memory + (shared_vectors(s) + action * network_vectors(s)) * lanes, lanes),
        points(theta.data + own_parameters(s) * lanes, lanes),
        L(points.data + (s.centres + 1) * s.inputs * lanes, lanes),
        w(L.data + row_of(s.centres) * lanes, lanes),
        factors(w.data + s.centres * lanes, lanes) {}
  static Index own_parameters(const RbfShape& s) { return s.inputs + s.centres * s.inputs + s.centres; }
  static Index shared_vectors(const RbfShape& s) { return s.inputs + s.centres; }
  static Index network_vectors(const RbfShape& s) {
    return own_parameters(s) + (s.centres + 2) * s.inputs + row_of(s.centres) + s.centres;
  }
  static Index vectors(const RbfShape& s) { return shared_vectors(s) + s.actions * network_vectors(s); }

  Lanes x, k;    // inputs, and their covariances with the centres
  Lanes theta;   // the action's parameters: log lengths, centres, targets
  Lanes points;  // centres and, last, the inputs, divided by the length scales
  Lanes L, w;
  Lanes factors;  // 1/ℓ of each input
};

/// Computes the network at θ: its centres, L, and L⁻¹ y in w.
HWY_INLINE void prepare(const RbfShape& s, const Block& block) {
  const D d;
  const Index n = s.centres, centres = s.inputs, targets = centres + n * s.inputs;
  for (Index i = 0; i < s.inputs; ++i) {
    const V factor = hn::Exp(d, hn::Neg(clamp(block.theta[i], kLargestLogLength)));
    block.factors.set(i, factor);
    for (Index c = 0; c < n; ++c)
      block.points.set(c * s.inputs + i, hn::Mul(block.theta[centres + c * s.inputs + i], factor));
  }
  factorise(block.points, s, block.L);
  for (Index c = 0; c < n; ++c) block.w.set(c, block.theta[targets + c]);
  solve(block.L, block.w, n);
}

/// kᵀ (K + σ_n² I)⁻¹ y, after `prepare`.
HWY_INLINE V act(const RbfShape& s, const Block& block) {
  const Index n = s.centres;
  for (Index i = 0; i < s.inputs; ++i) block.points.set(n * s.inputs + i, hn::Mul(block.x[i], block.factors[i]));
  for (Index c = 0; c < n; ++c) block.k.set(c, correlation(squared_distance(block.points, n, c, s.inputs)));
  solve(block.L, block.k, n);
  V mean = hn::Zero(D());
  for (Index c = 0; c < n; ++c) mean = hn::MulAdd(block.k[c], block.w[c], mean);
  return mean;
}

/// Loads rows [row, row + count) of some columns; a block that is not full is padded with its first row. True if that
/// changes the contents.
HWY_INLINE bool load(const double* from, Index stride, Index columns, Index row, Index count, const Lanes& to) {
  bool changed = false;
  for (Index c = 0; c < columns; ++c)
    for (Index i = 0; i < to.lanes; ++i) {
      const double value = from[c * stride + row + (i < count ? i : 0)];
      double& there = to.data[c * to.lanes + i];
      changed |= there != value;
      there = value;
    }
  return changed;
}

/// The same of an action's parameters.
HWY_INLINE bool load_network(const RbfShape& s, Index action, const double* theta, Index stride, Index row, Index count,
                             const Lanes& to) {
  const Index centres = s.actions * s.inputs, targets = centres + s.centres * s.inputs;
  const auto at = [&](Index i) { return Lanes(to.data + i * to.lanes, to.lanes); };
  bool changed = load(theta + action * s.inputs * stride, stride, s.inputs, row, count, to);
  changed |= load(theta + centres * stride, stride, s.centres * s.inputs, row, count, at(s.inputs));
  changed |= load(theta + (targets + action * s.centres) * stride, stride, s.centres, row, count,
                  at(s.inputs + s.centres * s.inputs));
  return changed;
}

/// A thread's block.
struct Memory {
  void reserve(const RbfShape& wanted, Index lanes) {
    const Index needed = Block::vectors(wanted) * lanes;
    if (shape == wanted && allocated > 0) return;
    if (needed > allocated) block = hwy::AllocateAligned<double>(static_cast<std::size_t>(needed)), allocated = needed;
    std::fill_n(block.get(), needed, kNaN);  // which no θ is
    shape = wanted;
  }

  hwy::AlignedFreeUniquePtr<double[]> block;
  Index allocated = 0;
  RbfShape shape{};
};

void RbfKernel(const RbfShape& shape, const double* theta, Index theta_stride, const double* in, Index in_stride,
               double* out, Index out_stride, Index rows) {
  thread_local Memory memory;
  const auto lanes = static_cast<Index>(hn::Lanes(D()));
  memory.reserve(shape, lanes);
  // Actions are outside, so that the cache keeps the network that all rows ask.
  for (Index a = 0; a < shape.actions; ++a) {
    const Block of_action(shape, a, memory.block.get(), lanes);
    for (Index row = 0; row < rows; row += lanes) {
      const Index count = rows - row < lanes ? rows - row : lanes;
      if (load_network(shape, a, theta, theta_stride, row, count, of_action.theta)) prepare(shape, of_action);
      load(in, in_stride, shape.inputs, row, count, of_action.x);
      of_action.k.set(0, act(shape, of_action));
      for (Index i = 0; i < count; ++i) out[a * out_stride + row + i] = of_action.k.data[i];
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::policy
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse::policy {

HWY_EXPORT(RbfKernel);

void rbf(const RbfShape& shape, const double* theta, Index theta_stride, const double* in, Index in_stride, double* out,
         Index out_stride, Index rows) {
  HWY_DYNAMIC_DISPATCH(RbfKernel)(shape, theta, theta_stride, in, in_stride, out, out_stride, rows);
}

}  // namespace rehearse::policy
#endif
