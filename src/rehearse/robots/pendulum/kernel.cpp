// The equations of the pendulum, written once for a single state and for as many as fit the vector registers.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/robots/pendulum/kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include "rehearse/robots/pendulum/kernel.hpp"
#include "rehearse/system/ode_kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::robots::pendulum {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace ode = rehearse::system::HWY_NAMESPACE;

constexpr double kGravity = 9.82;  // m/s²

/// A rod of mass m and length l with a torque on its axis; θ = 0 hanging. θ̈ m l²/3 = u − b θ̇ − m g l sin(θ)/2.
template <class D>
class Equations {
 public:
  using V = hn::Vec<D>;
  static constexpr int kStates = 2;  // θ̇, θ
  static constexpr int kAngles[] = {1};

  HWY_INLINE Equations(D d, const double* phi) {
    const double m = phi[0], l = phi[1], b = phi[2], inertia = m * l * l / 3;
    torque_ = hn::Set(d, 1 / inertia);
    friction_ = hn::Set(d, b / inertia);
    gravity_ = hn::Set(d, m * kGravity * l / 2 / inertia);
  }

  HWY_INLINE void operator()(const V* x, const V* trig, V u, V* dxdt) const {
    dxdt[0] = torque_ * u - hn::MulAdd(friction_, x[0], gravity_ * trig[0]);
    dxdt[1] = x[0];
  }

 private:
  V torque_, friction_, gravity_;
};

void DerivativeKernel(const double* x, double u, const double* phi, double* dxdt) {
  ode::slope_of_row<Equations>(x, u, phi, dxdt);
}

void ChangeKernel(const double* X, Index x_stride, const double* U, const double* phi, double dt_s, Index substeps,
                  double* dX, Index dx_stride, Index rows) {
  ode::change_rows<Equations>(X, x_stride, U, phi, dt_s, substeps, dX, dx_stride, rows);
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::robots::pendulum
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse::robots::pendulum {

HWY_EXPORT(DerivativeKernel);
HWY_EXPORT(ChangeKernel);

// Dispatched at each call: the address of a dispatched function is, before its first call, that of Highway's chooser,
// which asks the processor for its instruction sets every time.
system::OdeKernel kernel() {
  return {[](auto... arguments) { return HWY_DYNAMIC_DISPATCH(DerivativeKernel)(arguments...); },
          [](auto... arguments) { return HWY_DYNAMIC_DISPATCH(ChangeKernel)(arguments...); }};
}

}  // namespace rehearse::robots::pendulum
#endif
