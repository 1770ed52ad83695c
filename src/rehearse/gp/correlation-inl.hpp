// Included once for each instruction set, by kernel files only.
#if defined(REHEARSE_GP_CORRELATION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef REHEARSE_GP_CORRELATION_INL
#undef REHEARSE_GP_CORRELATION_INL
#else
#define REHEARSE_GP_CORRELATION_INL
#endif

#include <cstdint>

#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include "rehearse/core/eight-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::gp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using rehearse::HWY_NAMESPACE::kParts;
using rehearse::HWY_NAMESPACE::kTag;
using rehearse::HWY_NAMESPACE::lanes;
using rehearse::HWY_NAMESPACE::place_in_eight;
using rehearse::HWY_NAMESPACE::sum_of_eight;
using rehearse::HWY_NAMESPACE::Tag;
using rehearse::HWY_NAMESPACE::V;

HWY_INLINE V constant(double x) { return hn::Set(kTag, x); }

/// The coefficients, of r¹¹, r¹⁰, …, 1, of the polynomial that interpolates exp(r) at Chebyshev's points, |r| ≤ ½ ln 2
/// (relative error 3e-18).
constexpr int kExpDegree = 11;
constexpr double kExpCoefficients[kExpDegree + 1] = {2.5110037605963777e-08,
                                                     2.763263963904103e-07,
                                                     2.755724091857897e-06,
                                                     2.4801485482328494e-05,
                                                     0.00019841269890047113,
                                                     0.0013888888952314775,
                                                     0.008333333333319601,
                                                     0.0416666666664881,
                                                     0.1666666666666668,
                                                     0.5000000000000019,
                                                     1.0,
                                                     1.0};

/// x = k ln 2 + r: returns r, and in the last bits of `shifted` k.
HWY_INLINE V reduce(V x, V& shifted) {
  const V magic = constant(0x1.8p52);  // adding it rounds to an integer
  shifted = hn::MulAdd(x, constant(1.4426950408889634074), magic);
  const V k = hn::Sub(shifted, magic);
  const V r = hn::NegMulAdd(k, constant(6.93147180369123816490e-01), x);
  return hn::NegMulAdd(k, constant(1.90821492927058770002e-10), r);
}

/// p 2^k, with k as `reduce` left it.
HWY_INLINE V scale_by_power(V p, V shifted) {
  const hn::Repartition<std::int64_t, Tag> bits;
  const auto exponent = hn::ShiftLeft<52>(hn::BitCast(bits, shifted));
  return hn::BitCast(kTag, hn::Add(hn::BitCast(bits, p), exponent));
}

/// exp(x) for −80 ≤ x ≤ 0, within 2 units of the last place. Half the work of Highway's Exp, which serves all x.
HWY_INLINE V short_exp(V x) {
  V shifted;
  const V r = reduce(x, shifted);
  V p = constant(kExpCoefficients[0]);
  for (int i = 1; i <= kExpDegree; ++i) p = hn::MulAdd(p, r, constant(kExpCoefficients[i]));
  return scale_by_power(p, shifted);
}

/// exp(x), 0 below e^−80. x ≤ 0 but for rounding, −∞ too.
HWY_INLINE V small_exp(V x) {
  const V cut = constant(-80);
  return hn::IfThenElseZero(hn::Gt(x, cut), short_exp(hn::Max(x, cut)));
}

/// exp(−½ squared distance); `squared` may be infinite.
HWY_INLINE V correlation(V squared) { return small_exp(hn::Mul(squared, constant(-0.5))); }

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::gp
HWY_AFTER_NAMESPACE();

#endif
