#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/gp/kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include "rehearse/gp/correlation-inl.hpp"
#include "rehearse/gp/kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::gp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE Size lanes() { return static_cast<Size>(hn::Lanes(kTag)); }

/// Correlations of kVectors vectors of training points with point q, whose coordinates are `q_stride` apart.
template <int kVectors>
HWY_INLINE void correlations(const double* rows, Size stride, Size dimensions, const double* q, Size q_stride, V* out) {
  V squared[kVectors];
  for (int k = 0; k < kVectors; ++k) squared[k] = hn::Zero(kTag);
  for (Size d = 0; d < dimensions; ++d) {
    const V center = hn::Set(kTag, q[d * q_stride]);
    for (int k = 0; k < kVectors; ++k) {
      const V difference = hn::Sub(hn::LoadU(kTag, rows + d * stride + k * lanes()), center);
      squared[k] = hn::MulAdd(difference, difference, squared[k]);
    }
  }
  for (int k = 0; k < kVectors; ++k) out[k] = correlation(squared[k]);
}

template <int kVectors>
HWY_INLINE void store_correlations(const double* rows, Size stride, Size dimensions, const double* q, double* out) {
  V c[kVectors];
  correlations<kVectors>(rows, stride, dimensions, q, stride, c);
  for (int k = 0; k < kVectors; ++k) hn::StoreU(c[k], kTag, out + k * lanes());
}

void CorrelationMatrixKernel(const double* scaled, Size n, Size dimensions, double diagonal, double* matrix) {
  const Size stride = padded(n);
  for (Size j = 0; j < n; ++j) {
    double* column = matrix + j * stride;
    Size i = j / 8 * 8;
    for (; i + 4 * lanes() <= stride; i += 4 * lanes())
      store_correlations<4>(scaled + i, stride, dimensions, scaled + j, column + i);
    for (; i < stride; i += lanes()) store_correlations<1>(scaled + i, stride, dimensions, scaled + j, column + i);
    column[j] = diagonal;
  }
}

/// What column j and the rows i, i + 1, … of kVectors vectors add to the sums; `first`: only rows above j count.
template <int kVectors, bool kMasked>
HWY_INLINE void add_to_sums(const double* scaled, Size stride, Size dimensions, const double* b, const double* inverse,
                            Size i, Size j, double* sums) {
  V w[kVectors];
  correlations<kVectors>(scaled + i, stride, dimensions, scaled + j, stride, w);
  V total = hn::Zero(kTag);
  for (int k = 0; k < kVectors; ++k) {
    const Size row = i + k * lanes();
    const V bb = hn::Mul(hn::LoadU(kTag, b + row), hn::Set(kTag, b[j]));
    w[k] = hn::Mul(w[k], hn::Sub(bb, hn::LoadU(kTag, inverse + j * stride + row)));
    if (kMasked && row <= j) w[k] = hn::IfThenZeroElse(hn::FirstN(kTag, static_cast<size_t>(j + 1 - row)), w[k]);
    total = hn::Add(total, w[k]);
  }
  for (Size d = 0; d < dimensions; ++d) {
    const V center = hn::Set(kTag, scaled[d * stride + j]);
    V sum = hn::LoadU(kTag, sums + 8 * d);
    for (int k = 0; k < kVectors; ++k) {
      const V difference = hn::Sub(hn::LoadU(kTag, scaled + d * stride + i + k * lanes()), center);
      sum = hn::MulAdd(hn::Mul(w[k], difference), difference, sum);
    }
    hn::StoreU(sum, kTag, sums + 8 * d);
  }
  double* last = sums + 8 * dimensions;
  hn::StoreU(hn::Add(hn::LoadU(kTag, last), total), kTag, last);
}

void GradientSumsKernel(const double* scaled, Size n, Size dimensions, const double* b, const double* inverse,
                        double* sums) {
  const Size stride = padded(n);
  for (Size k = 0; k < 8 * (dimensions + 1); ++k) sums[k] = 0;
  for (Size j = 0; j < n; ++j) {
    Size i = j / 8 * 8;
    for (; i <= j; i += lanes()) add_to_sums<1, true>(scaled, stride, dimensions, b, inverse, i, j, sums);
    for (; i + 4 * lanes() <= stride; i += 4 * lanes())
      add_to_sums<4, false>(scaled, stride, dimensions, b, inverse, i, j, sums);
    for (; i < stride; i += lanes()) add_to_sums<1, false>(scaled, stride, dimensions, b, inverse, i, j, sums);
  }
  for (Size d = 0; d <= dimensions; ++d) sums[d] = hn::GetLane(hn::SumOfLanes(kTag, hn::LoadU(kTag, sums + 8 * d)));
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::gp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse::gp {

HWY_EXPORT(CorrelationMatrixKernel);
HWY_EXPORT(GradientSumsKernel);

void scale_inputs(const double* unit, Size n, Size dimensions, const double* factors, double* scaled) {
  constexpr double kFarAway = 1e100;
  const Size stride = padded(n);
  for (Size d = 0; d < dimensions; ++d) {
    for (Size i = 0; i < n; ++i) scaled[d * stride + i] = unit[d * n + i] * factors[d];
    for (Size i = n; i < stride; ++i) scaled[d * stride + i] = kFarAway;
  }
}
void correlation_matrix(const double* scaled, Size n, Size dimensions, double diagonal, double* matrix) {
  HWY_DYNAMIC_DISPATCH(CorrelationMatrixKernel)(scaled, n, dimensions, diagonal, matrix);
}
void gradient_sums(const double* scaled, Size n, Size dimensions, const double* b, const double* inverse,
                   double* sums) {
  HWY_DYNAMIC_DISPATCH(GradientSumsKernel)(scaled, n, dimensions, b, inverse, sums);
}

}  // namespace rehearse::gp
#endif
