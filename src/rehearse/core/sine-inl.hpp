// Vectorised sine and cosine of any angle. Included once for each instruction set inside a kernel file.

#if defined(REHEARSE_CORE_SINE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef REHEARSE_CORE_SINE_INL_HPP
#undef REHEARSE_CORE_SINE_INL_HPP
#else
#define REHEARSE_CORE_SINE_INL_HPP
#endif

#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include <hwy/contrib/math/math-inl.h>

#include "rehearse/core/angle.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse {
namespace HWY_NAMESPACE {

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
  namespace hn = hwy::HWY_NAMESPACE;
  const auto near = near_angle(d, angle);
  return hn::IfThenElse(hn::IsNaN(near), near, hn::Sin(d, near));
}

template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> cosine(D d, hwy::HWY_NAMESPACE::Vec<D> angle) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto near = near_angle(d, angle);
  return hn::IfThenElse(hn::IsNaN(near), near, hn::Cos(d, near));
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse
HWY_AFTER_NAMESPACE();
#endif
