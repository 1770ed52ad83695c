#include "rehearse/core/angle.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace rehearse {
namespace {

/// 1/(2π): two words before the binary point, then 1280 bits behind it.
constexpr std::uint32_t kTurnsPerRadian[] = {
    0,          0,          0x28be60db, 0x9391054a, 0x7f09d5f4, 0x7d4d3770, 0x36d8a566, 0x4f10e410, 0x7f9458ea,
    0xf7aef158, 0x6dc91b8e, 0x909374b8, 0x01924bba, 0x82746487, 0x3f877ac7, 0x2c4a69cf, 0xba208d7d, 0x4baed121,
    0x3a671c09, 0xad17df90, 0x4e64758e, 0x60d4ce7d, 0x272117e2, 0xef7e4a0e, 0xc7fe25ff, 0xf7816603, 0xfbcbc462,
    0xd6829b47, 0xdb4d9fb3, 0xc9f2c26d, 0xd3d18fd9, 0xa797fa8b, 0x5d49eeb1, 0xfaf97c5e, 0xcf41ce7d, 0xe294a4ba,
    0x9afed7ec, 0x47e35742, 0x1580cc11, 0xbf1edaea, 0xfc33ef08, 0x26bd0d87};

constexpr int kWords = 6;
using Fraction = std::array<std::uint32_t, kWords>;  // of a turn, the highest word first

/// The bits of 1/(2π) from 2^−(first + 1) on.
Fraction window(int first) {
  const int at = first + 64, shift = at % 32;
  Fraction bits;
  for (int i = 0; i < kWords; ++i) {
    const std::uint32_t* word = kTurnsPerRadian + at / 32 + i;
    const auto two = (std::uint64_t{word[0]} << 32) | word[1];
    bits[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(two << shift >> 32);
  }
  return bits;
}

/// The part behind the binary point of the product with a whole number of 32 bits.
Fraction times(const Fraction& fraction, std::uint32_t factor) {
  Fraction product{};
  std::uint64_t carry = 0;
  for (std::size_t i = kWords; i-- > 0;) {
    carry += std::uint64_t{fraction[i]} * factor;
    product[i] = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
  return product;
}

Fraction sum(const Fraction& a, const Fraction& b) {
  Fraction result{};
  std::uint64_t carry = 0;
  for (std::size_t i = kWords; i-- > 0;) {
    carry += std::uint64_t{a[i]} + b[i];
    result[i] = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
  return result;
}

/// The nearest double to a fraction's first 64 bits that are not zero.
double to_double(const Fraction& fraction) {
  for (std::size_t i = 0; i + 2 < kWords; ++i) {
    if (fraction[i] == 0) continue;
    const auto shift = std::countl_zero(fraction[i]);
    const auto high = (std::uint64_t{fraction[i]} << 32 | fraction[i + 1]) << shift;
    const auto low = std::uint64_t{fraction[i + 2]} << shift >> 32;
    return std::ldexp(static_cast<double>(high | low), -static_cast<int>(32 * (i + 2)) - shift);
  }
  return 0;
}

}  // namespace

double reduced_angle(double x) {
  if (!std::isfinite(x)) return kNaN;
  if (std::abs(x) <= std::numbers::pi) return x;
  int exponent = 0;
  const auto whole = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(x), &exponent), 53));
  // |x|/(2π) = whole 2^(exponent − 53)/(2π); what is before the binary point are turns.
  const Fraction per_unit = window(exponent - 53);
  Fraction high = times(per_unit, static_cast<std::uint32_t>(whole >> 32));
  std::copy(high.begin() + 1, high.end(), high.begin());  // times 2^32
  high.back() = 0;
  Fraction turns = sum(high, times(per_unit, static_cast<std::uint32_t>(whole)));
  const bool beyond_half = turns[0] >> 31 != 0;
  if (beyond_half)
    for (std::uint32_t& word : turns) word = ~word;
  const double angle = 2 * std::numbers::pi * to_double(turns);
  return beyond_half == std::signbit(x) ? angle : -angle;
}

void reduce_far_angles(double* x, Index n) {
  for (Index i = 0; i < n; ++i)
    if (!(std::abs(x[i]) < kDirectAngle)) x[i] = reduced_angle(x[i]);
}

}  // namespace rehearse
