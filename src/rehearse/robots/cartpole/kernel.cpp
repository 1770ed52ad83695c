// The equations of the cart-pole, written once for a single state and for as many as fit the vector registers.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/robots/cartpole/kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include "rehearse/robots/cartpole/kernel.hpp"
#include "rehearse/system/ode_kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::robots::cartpole {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace ode = rehearse::system::HWY_NAMESPACE;

constexpr double kGravity = 9.82;  // m/s²

/// Deisenroth 2010, appendix C.2: the pole is a rod of mass m and length l, θ = 0 hanging; the cart has mass M.
template <class D>
class Equations {
 public:
  using V = hn::Vec<D>;
  static constexpr int kStates = 4;  // x, ẋ, θ̇, θ
  static constexpr int kAngles[] = {3};

  HWY_INLINE Equations(D d, const double* phi) {
    const double m = phi[0], total = phi[0] + phi[1], l = phi[2], b = phi[3];
    const auto set = [d](double value) HWY_ATTR { return hn::Set(d, value); };
    friction_ = set(b), ml_ = set(m * l), two_l_ = set(2 * l), four_l_ = set(4 * l), three_ = set(3), six_ = set(6);
    inertia_ = set(4 * l * total), three_ml_ = set(3 * m * l);
    cart_gravity_ = set(3 * kGravity * m * l), pole_gravity_ = set(6 * kGravity * total);
    one_ = set(1);
  }

  HWY_INLINE void operator()(const V* x, const V* trig, V u, V* dxdt) const {
    const V sine = trig[0], cosine = trig[1];
    const V force = hn::NegMulAdd(friction_, x[1], u), swing = ml_ * x[2] * x[2] * sine;
    const V inverse = one_ / hn::NegMulAdd(three_ml_ * cosine, cosine, inertia_);
    dxdt[0] = x[1];
    dxdt[1] = hn::MulAdd(two_l_, swing, hn::MulAdd(four_l_, force, cart_gravity_ * sine * cosine)) * inverse;
    dxdt[2] = hn::Neg(hn::MulAdd(hn::MulAdd(three_, swing, six_ * force), cosine, pole_gravity_ * sine) * inverse);
    dxdt[3] = x[2];
  }

 private:
  V friction_, ml_, two_l_, four_l_, three_, six_, inertia_, three_ml_, cart_gravity_, pole_gravity_, one_;
};

void DerivativeKernel(const double* x, double u, const double* phi, double* dxdt) {
  ode::slope_of_row<Equations>(x, u, phi, dxdt);
}

void ChangeKernel(const double* X, Index x_stride, const double* U, const double* phi, double dt_s, Index substeps,
                  double* dX, Index dx_stride, Index rows) {
  ode::change_rows<Equations>(X, x_stride, U, phi, dt_s, substeps, dX, dx_stride, rows);
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::robots::cartpole
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse::robots::cartpole {

HWY_EXPORT(DerivativeKernel);
HWY_EXPORT(ChangeKernel);

// Dispatched at each call: the address of a dispatched function is, before its first call, that of Highway's chooser,
// which asks the processor for its instruction sets every time.
system::OdeKernel kernel() {
  return {[](auto... arguments) { return HWY_DYNAMIC_DISPATCH(DerivativeKernel)(arguments...); },
          [](auto... arguments) { return HWY_DYNAMIC_DISPATCH(ChangeKernel)(arguments...); }};
}

}  // namespace rehearse::robots::cartpole
#endif
