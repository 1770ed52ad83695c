// Fixed-step integration of many initial states at once, one vector lane each. Included once for each instruction set;
// equation_kernel.hpp makes an OdeKernel of it.

#if defined(REHEARSE_SYSTEM_ODE_KERNEL_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef REHEARSE_SYSTEM_ODE_KERNEL_INL_HPP
#undef REHEARSE_SYSTEM_ODE_KERNEL_INL_HPP
#else
#define REHEARSE_SYSTEM_ODE_KERNEL_INL_HPP
#endif

#include <initializer_list>

#include "rehearse/core/dormand_prince.hpp"
#include "rehearse/core/types.hpp"
#include "rehearse/system/batch.hpp"
#include "rehearse/system/pack-inl.hpp"
#include "rehearse/system/state-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::system {
namespace HWY_NAMESPACE {

/// out = x + h Σ_j a_j k_j over the first `Stages` slopes.
template <int Stages, int N, class Number>
HWY_INLINE void combine(const Number* x, const Number k[][N], const double (&a)[Stages], double h, Number* out) {
  Number weights[Stages];
  for (int j = 0; j < Stages; ++j) weights[j] = h * a[j];
  for (int i = 0; i < N; ++i) {
    out[i] = x[i];
    for (int j = 0; j < Stages; ++j)
      if (a[j] != 0) out[i] = mul_add(weights[j], k[j][i], out[i]);
  }
}

/// One step of Dormand and Prince 1980, fifth order. slopes(x, dxdt) writes the N derivatives at x.
template <int N, class Number, class Slopes>
HWY_INLINE void dopri5_step(const Slopes& slopes, Number* x, double h) {
  using namespace dormand_prince;
  Number k[6][N], y[N];
  slopes(x, k[0]);
  combine<1, N>(x, k, kStage2, h, y);
  slopes(y, k[1]);
  combine<2, N>(x, k, kStage3, h, y);
  slopes(y, k[2]);
  combine<3, N>(x, k, kStage4, h, y);
  slopes(y, k[3]);
  combine<4, N>(x, k, kStage5, h, y);
  slopes(y, k[4]);
  combine<5, N>(x, k, kStage6, h, y);
  slopes(y, k[5]);
  combine<6, N>(x, k, kEnd, h, x);
}

/// An equation whose state is longer by the sines and cosines of its angles, which obey (sin θ)' = cos θ θ̇: cheaper
/// than to turn them, and as exact as the steps. An equation without angles is itself.
template <class Equation, class Number>
class ExtendedEquation {
 public:
  static constexpr int kStates = Equation::kStates, kSize = kStates + 2 * kAngleCount<Equation>;

  HWY_INLINE ExtendedEquation(const Equation& equation, const Number* x, const Number* u) : equation_(equation), u_(u) {
    for (int i = 0; i < kStates; ++i) y_[i] = x[i];
    sines_and_cosines<Equation>(x, y_ + kStates);
  }

  HWY_INLINE void operator()(const Number* y, Number* slope) const {
    equation_(State<Equation, Number>(y, y + kStates), u_, slope);
    for (Index a = 0; a < kAngleCount<Equation>; ++a) {
      const Index sine = kStates + 2 * a, cosine = sine + 1;
      const Number rate = slope[kAnglesOf<Equation>[a]];
      slope[sine] = y[cosine] * rate;
      slope[cosine] = -(y[sine] * rate);
    }
  }

  HWY_INLINE void step(double h) { dopri5_step<kSize>(*this, y_, h); }
  HWY_INLINE const Number* state() const { return y_; }

 private:
  const Equation& equation_;
  const Number* u_;
  Number y_[kSize];
};

template <class Number>
HWY_INLINE Number polynomial(Number x, std::initializer_list<double> coefficients) {
  Number sum = 0.0;
  for (const double a : coefficients) sum = mul_add(sum, x, a);
  return sum;
}

/// An equation with sines and cosines that are turned along with the angles: then a step costs no trigonometric
/// function. Taylor's polynomials of the turn within a step: their error is below 1e-15 for 0.5 rad and 1e-10 for 1.
template <class Equation, class Number>
class TurningEquation {
 public:
  static constexpr int kStates = Equation::kStates, kCount = kAngleCount<Equation>;

  HWY_INLINE TurningEquation(const Equation& equation, const Number* x, const Number* u) : equation_(equation), u_(u) {
    for (int i = 0; i < kStates; ++i) x_[i] = x[i];
    sines_and_cosines<Equation>(x, trig_);
    remember_angles();
  }

  HWY_INLINE void operator()(const Number* x, Number* slope) const {
    Number trig[2 * kCount];
    turn(x, trig);
    equation_(State<Equation, Number>(x, trig), u_, slope);
  }

  HWY_INLINE void step(double h) {
    dopri5_step<kStates>(*this, x_, h);
    turn(x_, trig_);  // the step's end is where the next begins
    remember_angles();
  }
  HWY_INLINE const Number* state() const { return x_; }

 private:
  HWY_INLINE void remember_angles() {
    for (Index a = 0; a < kCount; ++a) angle_[a] = x_[kAnglesOf<Equation>[a]];
  }

  HWY_INLINE void turn(const Number* x, Number* trig) const {
    for (Index a = 0; a < kCount; ++a) {
      const Number turn = x[kAnglesOf<Equation>[a]] - angle_[a], square = turn * turn;
      const Number sine = turn * polynomial(square, {-1. / 39916800, 1. / 362880, -1. / 5040, 1. / 120, -1. / 6, 1});
      const Number cosine =
          polynomial(square, {1. / 479001600, -1. / 3628800, 1. / 40320, -1. / 720, 1. / 24, -1. / 2, 1});
      const Number s = trig_[2 * a], c = trig_[2 * a + 1];
      trig[2 * a] = mul_add(s, cosine, c * sine);
      trig[2 * a + 1] = neg_mul_add(s, sine, c * cosine);
    }
  }

  const Equation& equation_;
  const Number* u_;
  Number x_[kStates], angle_[kCount], trig_[2 * kCount];
};

template <class Equation, class Number>
using Integrand = std::conditional_t<kAngleCount<Equation> == 0 || kIntegratesSines<Equation>,
                                     ExtendedEquation<Equation, Number>, TurningEquation<Equation, Number>>;

/// x after `duration`; NaN where an angle turns by more than kLargestTurn, or is NaN.
template <class Equation, class Number>
HWY_INLINE void integrate(const Equation& equation, Number* x, const Number* u, double duration, Index steps) {
  Integrand<Equation, Number> integrand(equation, x, u);
  for (Index step = 0; step < steps; ++step) integrand.step(duration / static_cast<double>(steps));
  auto valid = hn::Eq(x[0].lanes(), x[0].lanes());
  for (const int angle : kAnglesOf<Equation>)
    valid = hn::And(valid, hn::Lt(abs(integrand.state()[angle] - x[angle]).lanes(), Number(kLargestTurn).lanes()));
  for (int i = 0; i < Equation::kStates; ++i)
    x[i] = hn::IfThenElse(valid, integrand.state()[i].lanes(), hn::NaN(typename Number::Tag()));
}

/// `count` numbers, where there are fewer than lanes padded with the first.
template <class D>
HWY_INLINE Pack<D> load(D d, const double* from, Index count) {
  if (count == static_cast<Index>(hn::Lanes(d))) return hn::LoadU(d, from);
  HWY_ALIGN double buffer[HWY_MAX_BYTES / sizeof(double)];
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) buffer[i] = from[static_cast<Index>(i) < count ? i : 0];
  return hn::Load(d, buffer);
}

/// Changes of all rows over `duration`, a block of lanes at a time.
template <class Equation>
HWY_INLINE void change_rows(const Batch& batch, const double* phi, double duration, Index steps) {
  const hn::ScalableTag<double> d;
  using Number = Pack<hn::ScalableTag<double>>;
  constexpr int N = Equation::kStates, M = Equation::kActions;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  HWY_ALIGN double buffer[HWY_MAX_BYTES / sizeof(double)];
  const Equation equation(phi);
  for (Index row = 0; row < batch.rows; row += lanes) {
    const Index count = batch.rows - row < lanes ? batch.rows - row : lanes;
    Number x[N], before[N], u[M];
    for (int i = 0; i < N; ++i) x[i] = before[i] = load(d, batch.X + i * batch.x_stride + row, count);
    for (int i = 0; i < M; ++i) u[i] = load(d, batch.U + i * batch.u_stride + row, count);
    integrate(equation, x, u, duration, steps);
    for (int i = 0; i < N; ++i) {
      hn::Store((x[i] - before[i]).lanes(), d, buffer);
      for (Index k = 0; k < count; ++k) batch.dX[i * batch.dx_stride + row + k] = buffer[k];
    }
  }
}

/// dxdt (kStates) at one state.
template <class Equation>
HWY_INLINE void slope_of_row(const double* x, const double* u, const double* phi, double* dxdt) {
  using D = hn::CappedTag<double, 1>;
  using Number = Pack<D>;
  constexpr int N = Equation::kStates, M = Equation::kActions;
  Number y[N + 2 * kAngleCount<Equation>], action[M], slope[N];
  for (int i = 0; i < N; ++i) y[i] = x[i];
  for (int i = 0; i < M; ++i) action[i] = u[i];
  sines_and_cosines<Equation>(y, y + N);
  const Equation equation(phi);
  equation(State<Equation, Number>(y, y + N), action, slope);
  for (int i = 0; i < N; ++i) hn::StoreU(slope[i].lanes(), D(), dxdt + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::system
HWY_AFTER_NAMESPACE();
#endif
