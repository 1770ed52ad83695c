// The equations of the pendubot, written once for a single state and for as many as fit the vector registers.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/robots/pendubot/kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include <hwy/contrib/math/math-inl.h>

#include "rehearse/robots/pendubot/kernel.hpp"
#include "rehearse/system/ode_kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::robots::pendubot {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace ode = rehearse::system::HWY_NAMESPACE;

constexpr double kGravity = 9.82;  // m/s²

/// Chatzilygeroudis 2018, section V: absolute angles counter-clockwise from upright. A θ̈ = b, A symmetric 2 × 2.
///
/// The state is extended by the sines and cosines of the angles, which obey their own equations (sin θ)' = cos θ θ̇:
/// then a step costs no trigonometric function, and is several times faster. Nothing depends on the angles then; they
/// come last.
template <class D>
class Equations {
 public:
  using V = hn::Vec<D>;
  static constexpr int kStates = 8, kInner = 6;  // θ̇1, θ̇2, sin θ1, cos θ1, sin θ2, cos θ2, θ1, θ2

  HWY_INLINE Equations(D d, const Constants& c)
      : a11_(hn::Set(d, c.l1 * c.l1 * (c.m1 / 4 + c.m2) + c.m1 * c.l1 * c.l1 / 12)),
        a22_(hn::Set(d, c.l2 * c.l2 * c.m2 / 4 + c.m2 * c.l2 * c.l2 / 12)),
        coupling_(hn::Set(d, 0.5 * c.m2 * c.l1 * c.l2)),
        gravity1_(hn::Set(d, kGravity * c.l1 * (0.5 * c.m1 + c.m2))),
        gravity2_(hn::Set(d, kGravity * 0.5 * c.m2 * c.l2)),
        b1_(hn::Set(d, c.b1)),
        b2_(hn::Set(d, c.b2)),
        zero_(hn::Zero(d)),
        one_(hn::Set(d, 1.0)) {}

  /// From θ̇1, θ̇2, θ1, θ2 and back.
  static HWY_INLINE void extend(D d, const V* state, V* x) {
    x[0] = state[0], x[1] = state[1], x[6] = state[2], x[7] = state[3];
    x[2] = rehearse::HWY_NAMESPACE::sine(d, x[6]);
    x[3] = rehearse::HWY_NAMESPACE::cosine(d, x[6]);
    x[4] = rehearse::HWY_NAMESPACE::sine(d, x[7]);
    x[5] = rehearse::HWY_NAMESPACE::cosine(d, x[7]);
  }
  static HWY_INLINE void shorten(const V* x, V* state) {
    state[0] = x[0], state[1] = x[1], state[2] = x[6], state[3] = x[7];
  }

  HWY_INLINE void operator()(const V* x, V u, V* dxdt) const {
    const V sin1 = x[2], cos1 = x[3], sin2 = x[4], cos2 = x[5];
    const V sin12 = hn::NegMulAdd(cos1, sin2, sin1 * cos2), cos12 = hn::MulAdd(cos1, cos2, sin1 * sin2);
    const V a12 = coupling_ * cos12, swing = coupling_ * sin12;
    const V rhs1 = hn::MulAdd(gravity1_, sin1, u) - hn::MulAdd(swing, x[1] * x[1], b1_ * x[0]);
    const V rhs2 = hn::MulAdd(swing, x[0] * x[0], gravity2_ * sin2) - b2_ * x[1];
    const V inverse = one_ / hn::NegMulAdd(a12, a12, a11_ * a22_);
    dxdt[0] = hn::NegMulAdd(a12, rhs2, a22_ * rhs1) * inverse;
    dxdt[1] = hn::NegMulAdd(a12, rhs1, a11_ * rhs2) * inverse;
    dxdt[2] = cos1 * x[0];
    dxdt[3] = hn::NegMulSub(sin1, x[0], zero_);
    dxdt[4] = cos2 * x[1];
    dxdt[5] = hn::NegMulSub(sin2, x[1], zero_);
    dxdt[6] = x[0];
    dxdt[7] = x[1];
  }

 private:
  V a11_, a22_, coupling_, gravity1_, gravity2_, b1_, b2_, zero_, one_;
};

void DerivativeKernel(const double* x, double u, const Constants& constants, double* dxdt) {
  using D = hn::CappedTag<double, 1>;
  using E = Equations<D>;
  const D d;
  hn::Vec<D> state[4], extended[E::kStates], slope[E::kStates];
  for (int i = 0; i < 4; ++i) state[i] = hn::LoadU(d, x + i);
  E::extend(d, state, extended);
  E(d, constants)(extended, hn::Set(d, u), slope);
  E::shorten(slope, state);
  for (int i = 0; i < 4; ++i) hn::StoreU(state[i], d, dxdt + i);
}

void ChangeKernel(const double* X, Index x_stride, const double* U, const Constants& constants, double dt_s,
                  Index substeps, double* dX, Index dx_stride, Index rows) {
  using D = hn::ScalableTag<double>;
  using V = hn::Vec<D>;
  using E = Equations<D>;
  const E equations(D(), constants);
  const auto step = [&](D d, V* x, const V* u) HWY_ATTR {
    const auto rhs = [&](D, const V* state, V* slope) HWY_ATTR { equations(state, u[0], slope); };
    V extended[E::kStates];
    const V before[] = {x[2], x[3]};
    E::extend(d, x, extended);
    ode::dopri5<E::kStates, E::kInner>(d, rhs, extended, dt_s, substeps);
    E::shorten(extended, x);
    static constexpr int kAngles[] = {2, 3};
    ode::blank_lost<4>(d, kAngles, before, x);
  };
  ode::for_each_block<4, 1>(X, x_stride, U, 0, dX, dx_stride, rows, step);
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::robots::pendubot
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse::robots::pendubot {

HWY_EXPORT(DerivativeKernel);
HWY_EXPORT(ChangeKernel);

void derivative(const double* x, double u, const Constants& constants, double* dxdt) {
  HWY_DYNAMIC_DISPATCH(DerivativeKernel)(x, u, constants, dxdt);
}

void change(const double* X, Index x_stride, const double* U, const Constants& constants, double dt_s, Index substeps,
            double* dX, Index dx_stride, Index rows) {
  HWY_DYNAMIC_DISPATCH(ChangeKernel)(X, x_stride, U, constants, dt_s, substeps, dX, dx_stride, rows);
}

}  // namespace rehearse::robots::pendubot
#endif
