#include "rehearse/expression/tape_kernel.hpp"

#ifndef HWY_BASELINE_TARGETS
#define HWY_BASELINE_TARGETS HWY_AVX2
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/expression/tape_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include <hwy/contrib/math/math-inl.h>

#include "rehearse/core/dormand_prince.hpp"
#include "rehearse/core/elementary-inl.hpp"
#include "rehearse/expression/scalar.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::expression {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;

template <class F>
HWY_INLINE void each(double* out, const double* a, Index n, F f) {
  const D d;
  for (Index i = 0; i < n; i += static_cast<Index>(hn::Lanes(d))) hn::Store(f(hn::Load(d, a + i)), d, out + i);
}
template <class F>
HWY_INLINE void each(double* out, const double* a, const double* b, Index n, F f) {
  const D d;
  for (Index i = 0; i < n; i += static_cast<Index>(hn::Lanes(d)))
    hn::Store(f(hn::Load(d, a + i), hn::Load(d, b + i)), d, out + i);
}
template <class F>
HWY_INLINE void each(double* out, const double* a, const double* b, const double* c, Index n, F f) {
  const D d;
  for (Index i = 0; i < n; i += static_cast<Index>(hn::Lanes(d)))
    hn::Store(f(hn::Load(d, a + i), hn::Load(d, b + i), hn::Load(d, c + i)), d, out + i);
}

using rehearse::HWY_NAMESPACE::keep_nan;

HWY_INLINE V smaller(V a, V b) { return hn::IfThenElse(hn::Or(hn::IsNaN(a), hn::Lt(a, b)), a, b); }
template <class M>
HWY_INLINE V truth(M holds, V a, V b) {
  const D d;
  return keep_nan(a, keep_nan(b, hn::IfThenElseZero(holds, hn::Set(d, 1.0))));
}
HWY_INLINE auto is_true(V a) { return hn::Ne(a, hn::Zero(D())); }

/// Calls the C library for each number: for operations without a vectorised function.
HWY_INLINE void one_by_one(const Instruction& i, double* out, const double* a, const double* b, Index n) {
  for (Index k = 0; k < n; ++k) out[k] = evaluate(i.op, a[k], b[k], 0);
}

/// Operations from memory to memory. Not inlined, so that registers are left to the others.
HWY_NOINLINE void execute(const Instruction& i, double* slots, Index n) {
  double* out = slots + i.out * kBlock;
  const double *a = slots + i.a * kBlock, *b = slots + i.b * kBlock, *c = slots + i.c * kBlock;
  const D d;
  switch (i.op) {
    case Op::sine:
      return each(out, a, n, [d](V x) HWY_ATTR { return rehearse::HWY_NAMESPACE::sine(d, x); });
    case Op::cosine:
      return each(out, a, n, [d](V x) HWY_ATTR { return rehearse::HWY_NAMESPACE::cosine(d, x); });
    case Op::hyperbolic_tangent:
      return each(out, a, n, [d](V x) HWY_ATTR { return rehearse::HWY_NAMESPACE::hyperbolic_tangent(d, x); });
    case Op::exponential:
      return each(out, a, n, [d](V x) HWY_ATTR { return rehearse::HWY_NAMESPACE::exponential(d, x); });
    case Op::square_root:
      return each(out, a, n, [](V x) HWY_ATTR { return hn::Sqrt(x); });
    case Op::absolute:
      return each(out, a, n, [](V x) HWY_ATTR { return hn::Abs(x); });
    case Op::minimum:
      return each(out, a, b, n, [](V x, V y) HWY_ATTR { return smaller(x, y); });
    case Op::maximum:
      return each(out, a, b, n, [](V x, V y) HWY_ATTR { return hn::Neg(smaller(hn::Neg(x), hn::Neg(y))); });
    case Op::less:
      return each(out, a, b, n, [](V x, V y) HWY_ATTR { return truth(hn::Lt(x, y), x, y); });
    case Op::less_equal:
      return each(out, a, b, n, [](V x, V y) HWY_ATTR { return truth(hn::Le(x, y), x, y); });
    case Op::equal:
      return each(out, a, b, n, [](V x, V y) HWY_ATTR { return truth(hn::Eq(x, y), x, y); });
    case Op::not_equal:
      return each(out, a, b, n, [](V x, V y) HWY_ATTR { return truth(hn::Ne(x, y), x, y); });
    case Op::logical_and:
      return each(out, a, b, n, [](V x, V y) HWY_ATTR { return truth(hn::And(is_true(x), is_true(y)), x, y); });
    case Op::logical_or:
      return each(out, a, b, n, [](V x, V y) HWY_ATTR { return truth(hn::Or(is_true(x), is_true(y)), x, y); });
    case Op::where:
      return each(out, a, b, c, n,
                  [](V x, V y, V z) HWY_ATTR { return keep_nan(x, hn::IfThenElse(is_true(x), y, z)); });
    default:
      return one_by_one(i, out, a, b, n);
  }
}

/// A slot: the vector from a row on.
struct Slot {
  HWY_INLINE Slot(const double* slots, std::int32_t slot) : numbers(slots + slot * kBlock) {}
  HWY_INLINE V operator()(Index row) const { return hn::Load(D(), numbers + row); }
  const double* numbers;
};

/// N vectors of rows. Results stay in registers until the next instruction: loads and stores are the most of the work.
template <int N>
struct Registers {
  V values[N];

  template <class F>
  HWY_INLINE void each(F f) {
    const Index lanes = static_cast<Index>(hn::Lanes(D()));
    HWY_UNROLL(8)
    for (int k = 0; k < N; ++k) values[k] = f(values[k], k * lanes);
  }

  template <class F>
  HWY_INLINE void one(const Instruction& i, const double* slots, F f) {
    if (i.in_registers == Argument::a) return each([=](V x, Index) HWY_ATTR { return f(x); });
    const Slot a(slots, i.a);
    each([=](V, Index k) HWY_ATTR { return f(a(k)); });
  }

  template <class F>
  HWY_INLINE void two(const Instruction& i, const double* slots, F f) {
    const Slot a(slots, i.a), b(slots, i.b);
    if (i.in_registers == Argument::a) return each([=](V x, Index k) HWY_ATTR { return f(x, b(k)); });
    if (i.in_registers == Argument::b) return each([=](V x, Index k) HWY_ATTR { return f(a(k), x); });
    each([=](V, Index k) HWY_ATTR { return f(a(k), b(k)); });
  }

  template <class F>
  HWY_INLINE void three(const Instruction& i, const double* slots, F f) {
    const Slot a(slots, i.a), b(slots, i.b), c(slots, i.c);
    if (i.in_registers == Argument::a) return each([=](V x, Index k) HWY_ATTR { return f(x, b(k), c(k)); });
    if (i.in_registers == Argument::b) return each([=](V x, Index k) HWY_ATTR { return f(a(k), x, c(k)); });
    if (i.in_registers == Argument::c) return each([=](V x, Index k) HWY_ATTR { return f(a(k), b(k), x); });
    each([=](V, Index k) HWY_ATTR { return f(a(k), b(k), c(k)); });
  }

  HWY_INLINE void store(double* out) {
    const D d;
    each([=](V x, Index k) HWY_ATTR {
      hn::Store(x, d, out + k);
      return x;
    });
  }

  /// One instruction of those that stay in registers; false of others.
  HWY_INLINE bool compute(const Instruction& i, const double* slots) {
    switch (i.op) {
      case Op::negate:
        return one(i, slots, [](V x) HWY_ATTR { return hn::Neg(x); }), true;
      case Op::add:
        return two(i, slots, [](V x, V y) HWY_ATTR { return hn::Add(x, y); }), true;
      case Op::subtract:
        return two(i, slots, [](V x, V y) HWY_ATTR { return hn::Sub(x, y); }), true;
      case Op::multiply:
        return two(i, slots, [](V x, V y) HWY_ATTR { return hn::Mul(x, y); }), true;
      case Op::divide:
        return two(i, slots, [](V x, V y) HWY_ATTR { return hn::Div(x, y); }), true;
      case Op::multiply_add:
        return three(i, slots, [](V x, V y, V z) HWY_ATTR { return hn::MulAdd(x, y, z); }), true;
      case Op::negative_multiply_add:
        return three(i, slots, [](V x, V y, V z) HWY_ATTR { return hn::NegMulAdd(x, y, z); }), true;
      default:
        return false;
    }
  }
};

template <int N>
HWY_INLINE void run_vectors(const Code& code, double* slots) {
  Registers<N> registers = {};
  for (const Instruction* i = code.instructions; i != code.instructions + code.count; ++i)
    if (!registers.compute(*i, slots))
      execute(*i, slots, N * static_cast<Index>(hn::Lanes(D())));
    else if (i->is_stored)
      registers.store(slots + i->out * kBlock);
}

HWY_INLINE void run_code(const Code& code, double* slots, Index n) {
  constexpr int kTogether = 8;  // vectors; more do not fit into AVX2's registers
  const Index lanes = static_cast<Index>(hn::Lanes(D()));
  Index row = 0;
  for (; row + kTogether * lanes <= n; row += kTogether * lanes) run_vectors<kTogether>(code, slots + row);
  for (; row < n; row += lanes) run_vectors<1>(code, slots + row);
}

HWY_INLINE void copy(double* to, const double* from, Index n) {
  each(to, from, n, [](V v) HWY_ATTR { return v; });
}

/// states = start + h Σ_j a_j k_j over the first `Stages` slopes; k: a slot for each state, stage by stage.
template <int Stages>
HWY_INLINE void combine(const double* start, const double* k, Index states, const double (&a)[Stages], double h,
                        double* out, Index n) {
  const D d;
  V weights[Stages];
  for (int j = 0; j < Stages; ++j) weights[j] = hn::Set(d, h * a[j]);
  for (Index s = 0; s < states; ++s)
    for (Index i = 0; i < n; i += static_cast<Index>(hn::Lanes(d))) {
      V sum = hn::Load(d, start + s * kBlock + i);
      for (int j = 0; j < Stages; ++j)
        if (a[j] != 0) sum = hn::MulAdd(weights[j], hn::Load(d, k + (j * states + s) * kBlock + i), sum);
      hn::Store(sum, d, out + s * kBlock + i);
    }
}

void IntegrateKernel(const BlockOde& ode, const Block& block, double* work, double h, Index steps) {
  using namespace dormand_prince;
  double* slots = block.slots;
  const Index n = whole_vectors(block.rows), states = ode.states;
  double *x = slots + ode.first_state * kBlock, *start = work, *k = work + states * kBlock;
  const auto slopes = [&](int stage) HWY_ATTR {
    run_code(ode.code, slots, n);
    for (Index s = 0; s < states; ++s) copy(k + (stage * states + s) * kBlock, slots + ode.slopes[s] * kBlock, n);
  };
  for (Index step = 0; step < steps; ++step) {
    for (Index s = 0; s < states; ++s) copy(start + s * kBlock, x + s * kBlock, n);
    slopes(0);
    combine(start, k, states, kStage2, h, x, n);
    slopes(1);
    combine(start, k, states, kStage3, h, x, n);
    slopes(2);
    combine(start, k, states, kStage4, h, x, n);
    slopes(3);
    combine(start, k, states, kStage5, h, x, n);
    slopes(4);
    combine(start, k, states, kStage6, h, x, n);
    slopes(5);
    combine(start, k, states, kEnd, h, x, n);
  }
}

void RunKernel(const Code& code, const Block& block) { run_code(code, block.slots, whole_vectors(block.rows)); }

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::expression
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse::expression {

HWY_EXPORT(RunKernel);
HWY_EXPORT(IntegrateKernel);

void run(const Code& code, const Block& block) { HWY_DYNAMIC_DISPATCH(RunKernel)(code, block); }

void integrate(const BlockOde& ode, const Block& block, double* work, double h, Index steps) {
  HWY_DYNAMIC_DISPATCH(IntegrateKernel)(ode, block, work, h, steps);
}

}  // namespace rehearse::expression
#endif
