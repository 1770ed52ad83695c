#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/core/vector_math.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include <hwy/contrib/math/math-inl.h>

#include "rehearse/core/elementary-inl.hpp"
#include "rehearse/core/vector_math.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;

/// out[i] = f(in[i]), the last vector padded with zeros.
template <class F>
HWY_INLINE void map(const double* in, double* out, Index n, F f) {
  const D d;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  Index i = 0;
  for (; i + lanes <= n; i += lanes) hn::StoreU(f(d, hn::LoadU(d, in + i)), d, out + i);
  if (i == n) return;
  HWY_ALIGN double tail[HWY_MAX_BYTES / sizeof(double)] = {};
  for (Index k = i; k < n; ++k) tail[k - i] = in[k];
  hn::Store(f(d, hn::Load(d, tail)), d, tail);
  for (Index k = i; k < n; ++k) out[k] = tail[k - i];
}

void ExpKernel(const double* in, double* out, Index n) {
  map(in, out, n, [](D d, auto x) HWY_ATTR { return exponential(d, x); });
}
void TanhKernel(const double* in, double* out, Index n) {
  map(in, out, n, [](D d, auto x) HWY_ATTR { return hyperbolic_tangent(d, x); });
}

void SinKernel(const double* in, double* out, Index n) {
  map(in, out, n, [](D d, auto x) HWY_ATTR { return sine(d, x); });
}
void CosKernel(const double* in, double* out, Index n) {
  map(in, out, n, [](D d, auto x) HWY_ATTR { return cosine(d, x); });
}

// With sin 3a = 3 sin a − 4 sin³ a.
void SineSquashKernel(const double* in, double* out, Index n) {
  map(in, out, n, [](D d, auto a) HWY_ATTR {
    const auto limit = hn::Set(d, 1e4);
    const auto sine = hn::Sin(d, hn::Max(hn::Neg(limit), hn::Min(a, limit)));
    return keep_nan(a, hn::Mul(hn::Mul(sine, hn::Set(d, 0.5)), hn::NegMulAdd(sine, sine, hn::Set(d, 3.0))));
  });
}

/// cosine = sqrt(−2 log(1 − u1)) cos(2π u2), sine with sin.
template <class V>
HWY_INLINE void box_muller(D d, V u1, V u2, V& cosine, V& sine) {
  const V radius = hn::Sqrt(hn::Mul(hn::Set(d, -2.0), hn::Log(d, hn::Sub(hn::Set(d, 1.0), u1))));
  const V angle = hn::Mul(hn::Set(d, 6.283185307179586), u2);
  cosine = hn::Mul(radius, hn::Cos(d, angle));
  sine = hn::Mul(radius, hn::Sin(d, angle));
}

void BoxMullerKernel(const double* u1, const double* u2, double* first, double* second, Index n) {
  const D d;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  hn::Vec<D> cosine, sine;
  Index i = 0;
  for (; i + lanes <= n; i += lanes) {
    box_muller(d, hn::LoadU(d, u1 + i), hn::LoadU(d, u2 + i), cosine, sine);
    hn::StoreU(cosine, d, first + i);
    if (second) hn::StoreU(sine, d, second + i);
  }
  if (i == n) return;
  HWY_ALIGN double tail[2][HWY_MAX_BYTES / sizeof(double)] = {};
  for (Index k = i; k < n; ++k) tail[0][k - i] = u1[k], tail[1][k - i] = u2[k];
  box_muller(d, hn::Load(d, tail[0]), hn::Load(d, tail[1]), cosine, sine);
  hn::Store(cosine, d, tail[0]), hn::Store(sine, d, tail[1]);
  for (Index k = i; k < n; ++k) {
    first[k] = tail[0][k - i];
    if (second) second[k] = tail[1][k - i];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse {

HWY_EXPORT(ExpKernel);
HWY_EXPORT(TanhKernel);
HWY_EXPORT(SinKernel);
HWY_EXPORT(CosKernel);
HWY_EXPORT(SineSquashKernel);
HWY_EXPORT(BoxMullerKernel);

void vector_exp(const double* in, double* out, Index n) { HWY_DYNAMIC_DISPATCH(ExpKernel)(in, out, n); }
void vector_tanh(const double* in, double* out, Index n) { HWY_DYNAMIC_DISPATCH(TanhKernel)(in, out, n); }
void vector_sin_cos(const double* in, double* sine, double* cosine, Index n) {
  if (in == sine) {  // the cosine first, while its argument is still there
    HWY_DYNAMIC_DISPATCH(CosKernel)(in, cosine, n);
    HWY_DYNAMIC_DISPATCH(SinKernel)(in, sine, n);
  } else {
    HWY_DYNAMIC_DISPATCH(SinKernel)(in, sine, n);
    HWY_DYNAMIC_DISPATCH(CosKernel)(in, cosine, n);
  }
}
void vector_sine_squash(const double* in, double* out, Index n) { HWY_DYNAMIC_DISPATCH(SineSquashKernel)(in, out, n); }
void box_muller(const double* uniform1, const double* uniform2, double* first, double* second, Index n) {
  HWY_DYNAMIC_DISPATCH(BoxMullerKernel)(uniform1, uniform2, first, second, n);
}

}  // namespace rehearse
#endif
