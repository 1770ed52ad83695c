// Included once for each instruction set, by kernel files only.
#if defined(REHEARSE_GP_CORRELATION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef REHEARSE_GP_CORRELATION_INL
#undef REHEARSE_GP_CORRELATION_INL
#else
#define REHEARSE_GP_CORRELATION_INL
#endif

#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rehearse::gp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 8>;
using V = hn::Vec<Tag>;
constexpr Tag kTag;

HWY_INLINE V constant(double x) { return hn::Set(kTag, x); }

/// exp(x) for −80 ≤ x ≤ 0, within 2 units of the last place: x = k ln 2 + r, a polynomial of degree 11 interpolates
/// exp(r) at Chebyshev's points (relative error 3e-18), k is added to the exponent. Half the work of Highway's Exp,
/// which serves all x.
HWY_INLINE V short_exp(V x) {
  const hn::Repartition<std::int64_t, Tag> bits;
  const V magic = constant(0x1.8p52);  // adding it rounds to an integer, held in the last bits
  const V shifted = hn::MulAdd(x, constant(1.4426950408889634074), magic);
  const V k = hn::Sub(shifted, magic);
  V r = hn::NegMulAdd(k, constant(6.93147180369123816490e-01), x);
  r = hn::NegMulAdd(k, constant(1.90821492927058770002e-10), r);
  V p = constant(2.5110037605963777e-08);
  for (const double c : {2.763263963904103e-07, 2.755724091857897e-06, 2.4801485482328494e-05, 0.00019841269890047113,
                         0.0013888888952314775, 0.008333333333319601, 0.0416666666664881, 0.1666666666666668,
                         0.5000000000000019, 1.0, 1.0})
    p = hn::MulAdd(p, r, constant(c));
  const auto exponent = hn::ShiftLeft<52>(hn::BitCast(bits, shifted));
  return hn::BitCast(kTag, hn::Add(hn::BitCast(bits, p), exponent));
}

/// exp(−½ squared distance), 0 where it is below e^−80; `squared` may be infinite.
HWY_INLINE V correlation(V squared) {
  const V x = hn::Mul(squared, constant(-0.5)), cut = constant(-80);
  return hn::IfThenElseZero(hn::Gt(x, cut), short_exp(hn::Max(x, cut)));
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::gp
HWY_AFTER_NAMESPACE();

#endif
