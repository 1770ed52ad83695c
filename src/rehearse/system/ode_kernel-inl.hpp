// Fixed-step integration of many initial states at once, one vector lane each. Included once for each instruction set
// inside HWY_NAMESPACE of a kernel file: see robots/pendubot/pendubot_kernel.cpp for an example.

#if defined(REHEARSE_SYSTEM_ODE_KERNEL_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef REHEARSE_SYSTEM_ODE_KERNEL_INL_HPP
#undef REHEARSE_SYSTEM_ODE_KERNEL_INL_HPP
#else
#define REHEARSE_SYSTEM_ODE_KERNEL_INL_HPP
#endif

#include <hwy/highway.h>

#include "rehearse/core/types.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::system {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class D>
using Vec = hn::Vec<D>;

/// out = x + h Σ_j a_j k_j over the first `Stages` slopes.
template <int Stages, int N, class D>
HWY_INLINE void combine(D d, const Vec<D>* x, const Vec<D> k[][N], const double* a, double h, Vec<D>* out) {
  Vec<D> weights[Stages];
  for (int j = 0; j < Stages; ++j) weights[j] = hn::Set(d, h * a[j]);
  for (int i = 0; i < N; ++i) {
    out[i] = x[i];
    for (int j = 0; j < Stages; ++j) out[i] = hn::MulAdd(weights[j], k[j][i], out[i]);
  }
}

/// `steps` steps of Dormand and Prince 1980, fifth order. rhs(d, x, dx) writes the N derivatives at x.
template <int N, class D, class Rhs>
HWY_INLINE void dopri5(D d, const Rhs& rhs, Vec<D>* x, double duration, Index steps) {
  static constexpr double kA2[] = {1.0 / 5}, kA3[] = {3.0 / 40, 9.0 / 40}, kA4[] = {44.0 / 45, -56.0 / 15, 32.0 / 9},
                          kA5[] = {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                          kA6[] = {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                          kB[] = {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84};
  const double h = duration / static_cast<double>(steps);
  Vec<D> k[6][N], y[N];
  for (Index step = 0; step < steps; ++step) {
    rhs(d, x, k[0]);
    combine<1, N>(d, x, k, kA2, h, y);
    rhs(d, y, k[1]);
    combine<2, N>(d, x, k, kA3, h, y);
    rhs(d, y, k[2]);
    combine<3, N>(d, x, k, kA4, h, y);
    rhs(d, y, k[3]);
    combine<4, N>(d, x, k, kA5, h, y);
    rhs(d, y, k[4]);
    combine<5, N>(d, x, k, kA6, h, y);
    rhs(d, y, k[5]);
    combine<6, N>(d, x, k, kB, h, x);
  }
}

/// For each block of lanes of the rows of X (n × N) and U (n × M), column-major with strides: loads them, calls
/// step(d, x, u), and stores the change of x in dX. The last block is padded with its first row.
template <int N, int M, class Step>
HWY_INLINE void for_each_block(const double* X, Index x_stride, const double* U, Index u_stride, double* dX,
                               Index dx_stride, Index rows, const Step& step) {
  const hn::ScalableTag<double> d;
  using D = decltype(d);
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  HWY_ALIGN double buffer[HWY_MAX_BYTES / sizeof(double)];
  const auto load = [&](const double* from, Index count) HWY_ATTR {
    if (count == lanes) return hn::LoadU(d, from);
    for (Index i = 0; i < lanes; ++i) buffer[i] = from[i < count ? i : 0];
    return hn::Load(d, buffer);
  };
  for (Index row = 0; row < rows; row += lanes) {
    const Index count = rows - row < lanes ? rows - row : lanes;
    Vec<D> x[N], before[N], u[M];
    for (int i = 0; i < N; ++i) x[i] = before[i] = load(X + i * x_stride + row, count);
    for (int i = 0; i < M; ++i) u[i] = load(U + i * u_stride + row, count);
    step(d, x, u);
    for (int i = 0; i < N; ++i) {
      hn::Store(hn::Sub(x[i], before[i]), d, buffer);
      for (Index k = 0; k < count; ++k) dX[i * dx_stride + row + k] = buffer[k];
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::system
HWY_AFTER_NAMESPACE();
#endif
