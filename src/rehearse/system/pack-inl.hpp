// The number type of equations: as many doubles as a vector register holds. Included once for each instruction set.

#if defined(REHEARSE_SYSTEM_PACK_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef REHEARSE_SYSTEM_PACK_INL_HPP
#undef REHEARSE_SYSTEM_PACK_INL_HPP
#else
#define REHEARSE_SYSTEM_PACK_INL_HPP
#endif

#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include <hwy/contrib/math/math-inl.h>

#include "rehearse/core/elementary-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::system {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A number for each lane of D. What is added, multiplied or called is that of each lane; a double stands for itself in
/// all. Functions are within a few units of the last place, and keep NaN.
template <class D>
class Pack {
 public:
  using Tag = D;
  using V = hn::Vec<D>;
  Pack() = default;
  HWY_INLINE Pack(V lanes) : lanes_(lanes) {}
  HWY_INLINE Pack(double value) : lanes_(hn::Set(D(), value)) {}
  HWY_INLINE V lanes() const { return lanes_; }

  friend HWY_INLINE Pack operator+(Pack a, Pack b) { return hn::Add(a.lanes_, b.lanes_); }
  friend HWY_INLINE Pack operator-(Pack a, Pack b) { return hn::Sub(a.lanes_, b.lanes_); }
  friend HWY_INLINE Pack operator*(Pack a, Pack b) { return hn::Mul(a.lanes_, b.lanes_); }
  friend HWY_INLINE Pack operator/(Pack a, Pack b) { return hn::Div(a.lanes_, b.lanes_); }
  friend HWY_INLINE Pack operator-(Pack a) { return hn::Neg(a.lanes_); }
  HWY_INLINE Pack& operator+=(Pack b) { return *this = *this + b; }
  HWY_INLINE Pack& operator-=(Pack b) { return *this = *this - b; }
  HWY_INLINE Pack& operator*=(Pack b) { return *this = *this * b; }
  HWY_INLINE Pack& operator/=(Pack b) { return *this = *this / b; }

  /// a b + c and c − a b, rounded once.
  friend HWY_INLINE Pack mul_add(Pack a, Pack b, Pack c) { return hn::MulAdd(a.lanes_, b.lanes_, c.lanes_); }
  friend HWY_INLINE Pack neg_mul_add(Pack a, Pack b, Pack c) { return hn::NegMulAdd(a.lanes_, b.lanes_, c.lanes_); }

  friend HWY_INLINE Pack sin(Pack a) { return rehearse::HWY_NAMESPACE::sine(D(), a.lanes_); }
  friend HWY_INLINE Pack cos(Pack a) { return rehearse::HWY_NAMESPACE::cosine(D(), a.lanes_); }
  friend HWY_INLINE Pack exp(Pack a) { return rehearse::HWY_NAMESPACE::exponential(D(), a.lanes_); }
  friend HWY_INLINE Pack tanh(Pack a) { return rehearse::HWY_NAMESPACE::hyperbolic_tangent(D(), a.lanes_); }
  friend HWY_INLINE Pack sqrt(Pack a) { return hn::Sqrt(a.lanes_); }
  friend HWY_INLINE Pack abs(Pack a) { return hn::Abs(a.lanes_); }

 private:
  V lanes_;
};

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::system
HWY_AFTER_NAMESPACE();
#endif
