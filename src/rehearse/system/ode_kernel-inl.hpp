// Fixed-step integration of many initial states at once, one vector lane each. Included once for each instruction set
// inside HWY_NAMESPACE of a kernel file: see robots/cartpole/kernel.cpp for an example.

#if defined(REHEARSE_SYSTEM_ODE_KERNEL_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef REHEARSE_SYSTEM_ODE_KERNEL_INL_HPP
#undef REHEARSE_SYSTEM_ODE_KERNEL_INL_HPP
#else
#define REHEARSE_SYSTEM_ODE_KERNEL_INL_HPP
#endif

#include <initializer_list>

#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include <hwy/contrib/math/math-inl.h>

#include "rehearse/core/sine-inl.hpp"
#include "rehearse/core/types.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::system {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class D>
using Vec = hn::Vec<D>;

/// out = x + h Σ_j a_j k_j over the first `Stages` slopes, for the first `Count` of N states.
template <int Stages, int Count, int N, class D>
HWY_INLINE void combine(D d, const Vec<D>* x, const Vec<D> k[][N], const double (&a)[Stages], double h, Vec<D>* out) {
  Vec<D> weights[Stages];
  for (int j = 0; j < Stages; ++j) weights[j] = hn::Set(d, h * a[j]);
  for (int i = 0; i < Count; ++i) {
    out[i] = x[i];
    for (int j = 0; j < Stages; ++j)
      if (a[j] != 0) out[i] = hn::MulAdd(weights[j], k[j][i], out[i]);
  }
}

/// One step of Dormand and Prince 1980, fifth order. rhs(d, x, dx) writes the N derivatives at x; if they depend on the
/// first kInner states alone, the stages leave out the others.
template <int N, int kInner = N, class D, class Rhs>
HWY_INLINE void dopri5_step(D d, const Rhs& rhs, Vec<D>* x, double h) {
  static constexpr double kA2[] = {1.0 / 5}, kA3[] = {3.0 / 40, 9.0 / 40}, kA4[] = {44.0 / 45, -56.0 / 15, 32.0 / 9},
                          kA5[] = {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                          kA6[] = {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                          kB[] = {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84};
  Vec<D> k[6][N], y[N];
  rhs(d, x, k[0]);
  combine<1, kInner, N>(d, x, k, kA2, h, y);
  rhs(d, y, k[1]);
  combine<2, kInner, N>(d, x, k, kA3, h, y);
  rhs(d, y, k[2]);
  combine<3, kInner, N>(d, x, k, kA4, h, y);
  rhs(d, y, k[3]);
  combine<4, kInner, N>(d, x, k, kA5, h, y);
  rhs(d, y, k[4]);
  combine<5, kInner, N>(d, x, k, kA6, h, y);
  rhs(d, y, k[5]);
  combine<6, N, N>(d, x, k, kB, h, x);
}

/// `steps` of them.
template <int N, int kInner = N, class D, class Rhs>
HWY_INLINE void dopri5(D d, const Rhs& rhs, Vec<D>* x, double duration, Index steps) {
  for (Index step = 0; step < steps; ++step) dopri5_step<N, kInner>(d, rhs, x, duration / static_cast<double>(steps));
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

// Robots whose state holds angles and whose action is one number: a class `Equations` with
//
//   static constexpr int kStates;
//   static constexpr int kAngles[];                            // which states are angles
//   Equations(D d, const double* phi);
//   void operator()(const V* x, const V* trig, V u, V* dxdt);  // trig: sine and cosine of each angle

constexpr double kLargestTurn = 30000;  // rad in a control step; what turns further is a simulation that lost its way

template <class Equations>
constexpr int angles_of = sizeof(Equations::kAngles) / sizeof(int);

template <class Equations, class D>
HWY_INLINE void sines_and_cosines(D d, const Vec<D>* x, Vec<D>* trig) {
  for (int a = 0; a < angles_of<Equations>; ++a) {
    trig[2 * a] = rehearse::HWY_NAMESPACE::sine(d, x[Equations::kAngles[a]]);
    trig[2 * a + 1] = rehearse::HWY_NAMESPACE::cosine(d, x[Equations::kAngles[a]]);
  }
}

template <class D>
HWY_INLINE Vec<D> polynomial(D d, Vec<D> x, std::initializer_list<double> coefficients) {
  Vec<D> sum = hn::Zero(d);
  for (const double a : coefficients) sum = hn::MulAdd(sum, x, hn::Set(d, a));
  return sum;
}

/// The equations with sines and cosines that are turned along with the angles: then a step costs no trigonometric
/// function. Taylor's polynomials of the turn within a step: their error is below 1e-15 for 0.5 rad and 1e-10 for 1.
template <class Equations, class D>
class TurningEquations {
 public:
  static constexpr int kCount = angles_of<Equations>;

  HWY_INLINE TurningEquations(D d, const Equations& equations, const Vec<D>* x, Vec<D> u)
      : equations_(equations), u_(u) {
    sines_and_cosines<Equations>(d, x, trig_);
    for (int a = 0; a < kCount; ++a) angle_[a] = x[Equations::kAngles[a]];
  }

  HWY_INLINE void operator()(D d, const Vec<D>* x, Vec<D>* slope) const {
    Vec<D> trig[2 * kCount];
    turned(d, x, trig);
    equations_(x, trig, u_, slope);
  }

  /// The step's end is where the next begins.
  HWY_INLINE void advance(D d, const Vec<D>* x) {
    turned(d, x, trig_);
    for (int a = 0; a < kCount; ++a) angle_[a] = x[Equations::kAngles[a]];
  }

 private:
  HWY_INLINE void turned(D d, const Vec<D>* x, Vec<D>* trig) const {
    for (int a = 0; a < kCount; ++a) {
      const Vec<D> turn = hn::Sub(x[Equations::kAngles[a]], angle_[a]), square = hn::Mul(turn, turn);
      const Vec<D> sine =
          hn::Mul(turn, polynomial(d, square, {-1. / 39916800, 1. / 362880, -1. / 5040, 1. / 120, -1. / 6, 1}));
      const Vec<D> cosine =
          polynomial(d, square, {1. / 479001600, -1. / 3628800, 1. / 40320, -1. / 720, 1. / 24, -1. / 2, 1});
      const Vec<D> s = trig_[2 * a], c = trig_[2 * a + 1];
      trig[2 * a] = hn::MulAdd(s, cosine, hn::Mul(c, sine));
      trig[2 * a + 1] = hn::NegMulAdd(s, sine, hn::Mul(c, cosine));
    }
  }

  const Equations& equations_;
  Vec<D> u_, angle_[kCount], trig_[2 * kCount];
};

/// Leaves NaN in all of x where one of `angles`, which were `before`, has turned by more than kLargestTurn or is NaN.
template <int N, class D, std::size_t Angles>
HWY_INLINE void blank_lost(D d, const int (&angles)[Angles], const Vec<D>* before, Vec<D>* x) {
  auto valid = hn::Eq(before[0], before[0]);
  for (std::size_t a = 0; a < Angles; ++a)
    valid = hn::And(valid, hn::Lt(hn::Abs(hn::Sub(x[angles[a]], before[a])), hn::Set(d, kLargestTurn)));
  for (int i = 0; i < N; ++i) x[i] = hn::IfThenElse(valid, x[i], hn::NaN(d));
}

/// x after `duration`; NaN where an angle turns by more than kLargestTurn.
template <class Equations, class D>
HWY_INLINE void integrate_angles(D d, const Equations& equations, Vec<D>* x, Vec<D> u, double duration, Index steps) {
  Vec<D> before[angles_of<Equations>];
  for (int a = 0; a < angles_of<Equations>; ++a) before[a] = x[Equations::kAngles[a]];
  TurningEquations<Equations, D> rhs(d, equations, x, u);
  for (Index step = 0; step < steps; ++step) {
    dopri5_step<Equations::kStates>(d, rhs, x, duration / static_cast<double>(steps));
    rhs.advance(d, x);
  }
  blank_lost<Equations::kStates>(d, Equations::kAngles, before, x);
}

/// Changes of n states (X, dX: n × kStates) under n actions over `duration`.
template <template <class> class Equations>
HWY_INLINE void change_rows(const double* X, Index x_stride, const double* U, const double* phi, double duration,
                            Index steps, double* dX, Index dx_stride, Index rows) {
  using D = hn::ScalableTag<double>;
  const Equations<D> equations(D(), phi);
  const auto step = [&](D d, Vec<D>* x, const Vec<D>* u)
                        HWY_ATTR { integrate_angles(d, equations, x, u[0], duration, steps); };
  for_each_block<Equations<D>::kStates, 1>(X, x_stride, U, 0, dX, dx_stride, rows, step);
}

/// dxdt (kStates) at one state.
template <template <class> class Equations>
HWY_INLINE void slope_of_row(const double* x, double u, const double* phi, double* dxdt) {
  using D = hn::CappedTag<double, 1>;
  constexpr int N = Equations<D>::kStates;
  const D d;
  Vec<D> state[N], trig[2 * angles_of<Equations<D>>], slope[N];
  for (int i = 0; i < N; ++i) state[i] = hn::LoadU(d, x + i);
  sines_and_cosines<Equations<D>>(d, state, trig);
  Equations<D>(d, phi)(state, trig, hn::Set(d, u), slope);
  for (int i = 0; i < N; ++i) hn::StoreU(slope[i], d, dxdt + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::system
HWY_AFTER_NAMESPACE();
#endif
