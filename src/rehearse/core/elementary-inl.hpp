// Vectorised elementary functions of any number, which keep NaN. Included once for each instruction set inside a kernel
// file.

#if defined(REHEARSE_CORE_ELEMENTARY_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef REHEARSE_CORE_ELEMENTARY_INL_HPP
#undef REHEARSE_CORE_ELEMENTARY_INL_HPP
#else
#define REHEARSE_CORE_ELEMENTARY_INL_HPP
#endif

#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include <hwy/contrib/math/math-inl.h>

#include "rehearse/core/angle.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse {
namespace HWY_NAMESPACE {

/// `out`, but `in` where that is NaN: Highway 1.0.3's functions may lose it.
template <class V>
HWY_INLINE V keep_nan(V in, V out) {
  namespace hn = hwy::HWY_NAMESPACE;
  return hn::IfThenElse(hn::IsNaN(in), in, out);
}

/// The angle where Highway's functions are valid; NaN if it is not finite.
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> near_angle(D d, hwy::HWY_NAMESPACE::Vec<D> angle) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto direct = hn::Lt(hn::Abs(angle), hn::Set(d, kDirectAngle));
  if (HWY_LIKELY(hn::AllTrue(d, direct))) return angle;
  HWY_ALIGN double lanes[HWY_MAX_BYTES / sizeof(double)];
  hn::Store(angle, d, lanes);
  reduce_far_angles(lanes, static_cast<Index>(hn::Lanes(d)));
  return hn::Load(d, lanes);
}

template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> sine(D d, hwy::HWY_NAMESPACE::Vec<D> angle) {
  const auto near = near_angle(d, angle);
  return keep_nan(near, hwy::HWY_NAMESPACE::Sin(d, near));
}

template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> cosine(D d, hwy::HWY_NAMESPACE::Vec<D> angle) {
  const auto near = near_angle(d, angle);
  return keep_nan(near, hwy::HWY_NAMESPACE::Cos(d, near));
}

/// e^x. Highway's is anything from 0 to infinity where it overflows.
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> exponential(D d, hwy::HWY_NAMESPACE::Vec<D> x) {
  namespace hn = hwy::HWY_NAMESPACE;
  return keep_nan(x, hn::IfThenElse(hn::Gt(x, hn::Set(d, 709.78)), hn::Inf(d), hn::Exp(d, x)));
}

template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> hyperbolic_tangent(D d, hwy::HWY_NAMESPACE::Vec<D> x) {
  return keep_nan(x, hwy::HWY_NAMESPACE::Tanh(d, x));
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse
HWY_AFTER_NAMESPACE();
#endif
