// The vectorised exponential. Included once for each instruction set inside a kernel file.

#if defined(REHEARSE_CORE_EXPONENTIAL_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef REHEARSE_CORE_EXPONENTIAL_INL_HPP
#undef REHEARSE_CORE_EXPONENTIAL_INL_HPP
#else
#define REHEARSE_CORE_EXPONENTIAL_INL_HPP
#endif

#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace rehearse {
namespace HWY_NAMESPACE {

/// e^x. Highway 1.0.3's is 0 of NaN, and anything from 0 to infinity where it overflows.
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> exponential(D d, hwy::HWY_NAMESPACE::Vec<D> x) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto finite = hn::IfThenElse(hn::Gt(x, hn::Set(d, 709.78)), hn::Inf(d), hn::Exp(d, x));
  return hn::IfThenElse(hn::IsNaN(x), x, finite);
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse
HWY_AFTER_NAMESPACE();
#endif
