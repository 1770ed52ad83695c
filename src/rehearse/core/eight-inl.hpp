// Eight doubles, whatever the width of the processor's vectors: one vector of AVX-512, two of AVX2. What sums over rows
// keeps eight partial sums, of the rows 8k, 8k + 1, …, 8k + 7, and adds these in a fixed order: then the result has the
// same bits on every processor. Included once for each instruction set inside a kernel file.

#if defined(REHEARSE_CORE_EIGHT_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef REHEARSE_CORE_EIGHT_INL_HPP
#undef REHEARSE_CORE_EIGHT_INL_HPP
#else
#define REHEARSE_CORE_EIGHT_INL_HPP
#endif

#include <cstddef>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rehearse {
namespace HWY_NAMESPACE {

using Tag = hwy::HWY_NAMESPACE::CappedTag<double, 8>;
using V = hwy::HWY_NAMESPACE::Vec<Tag>;
constexpr Tag kTag;

/// Doubles of a vector, and vectors of eight doubles.
HWY_INLINE std::ptrdiff_t lanes() { return static_cast<std::ptrdiff_t>(hwy::HWY_NAMESPACE::Lanes(kTag)); }
constexpr int kParts = 8 / static_cast<int>(hwy::HWY_NAMESPACE::MaxLanes(Tag()));

/// The place of `row`, which is that of a vector's first lane, in its group of eight rows.
HWY_INLINE std::ptrdiff_t place_in_eight(std::ptrdiff_t row) { return kParts == 1 ? 0 : row % 8; }

/// The sum of eight consecutive doubles.
HWY_INLINE double sum_of_eight(const double* s) {
  return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}

HWY_INLINE double sum_of_eight(const V* parts) {
  HWY_ALIGN double sums[8];
  for (int p = 0; p < kParts; ++p) hwy::HWY_NAMESPACE::Store(parts[p], kTag, sums + p * lanes());
  return sum_of_eight(sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse
HWY_AFTER_NAMESPACE();
#endif
