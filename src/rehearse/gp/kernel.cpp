#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/gp/kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include <hwy/contrib/math/math-inl.h>

#include "rehearse/gp/kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::gp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 8>;
using V = hn::Vec<Tag>;
constexpr Tag kTag;

HWY_INLINE Size lanes() { return static_cast<Size>(hn::Lanes(kTag)); }

/// exp(−½ squared distance), 0 where far; `squared` may be infinite.
HWY_INLINE V correlation(V squared) {
  const V cut = hn::Set(kTag, -80.0);
  const V x = hn::Mul(hn::Set(kTag, -0.5), squared);
  return hn::IfThenElseZero(hn::Gt(x, cut), hn::Exp(kTag, hn::Max(x, cut)));
}

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

/// Four queries against kVectors vectors of training points.
template <int kVectors>
HWY_INLINE void correlate_block(const double* rows, Size stride, Size dimensions, const double* weights,
                                const double* queries, double* columns, V* means) {
  V squared[4][kVectors];
  for (int q = 0; q < 4; ++q)
    for (int k = 0; k < kVectors; ++k) squared[q][k] = hn::Zero(kTag);
  for (Size d = 0; d < dimensions; ++d) {
    V row[kVectors];
    for (int k = 0; k < kVectors; ++k) row[k] = hn::LoadU(kTag, rows + d * stride + k * lanes());
    for (int q = 0; q < 4; ++q) {
      const V center = hn::Set(kTag, queries[q * dimensions + d]);
      for (int k = 0; k < kVectors; ++k) {
        const V difference = hn::Sub(row[k], center);
        squared[q][k] = hn::MulAdd(difference, difference, squared[q][k]);
      }
    }
  }
  for (int q = 0; q < 4; ++q) {
    for (int k = 0; k < kVectors; ++k) {
      const V c = correlation(squared[q][k]);
      means[q] = hn::MulAdd(c, hn::LoadU(kTag, weights + k * lanes()), means[q]);
      if (columns) hn::StoreU(c, kTag, columns + q * stride + k * lanes());
    }
  }
}

void CorrelateKernel(const double* scaled, Size n, Size dimensions, const double* weights, const double* queries,
                     Size count, double* columns, double* means) {
  const Size stride = padded(n);
  for (Size q = 0; q < count; q += 4) {
    const double* query = queries + q * dimensions;
    double* column = columns ? columns + q * stride : nullptr;
    V sums[4] = {hn::Zero(kTag), hn::Zero(kTag), hn::Zero(kTag), hn::Zero(kTag)};
    Size i = 0;
    for (; i + 2 * lanes() <= stride; i += 2 * lanes())
      correlate_block<2>(scaled + i, stride, dimensions, weights + i, query, column ? column + i : nullptr, sums);
    for (; i < stride; i += lanes())
      correlate_block<1>(scaled + i, stride, dimensions, weights + i, query, column ? column + i : nullptr, sums);
    for (int k = 0; k < 4; ++k) means[q + k] = hn::GetLane(hn::SumOfLanes(kTag, sums[k]));
  }
}

void SquaredNormsKernel(const double* columns, Size n, Size count, double* norms) {
  const Size stride = padded(n);
  for (Size q = 0; q < count; ++q) {
    const double* column = columns + q * stride;
    V even = hn::Zero(kTag), odd = hn::Zero(kTag);
    Size i = 0;
    for (; i + 2 * lanes() <= stride; i += 2 * lanes()) {
      const V first = hn::LoadU(kTag, column + i), second = hn::LoadU(kTag, column + i + lanes());
      even = hn::MulAdd(first, first, even);
      odd = hn::MulAdd(second, second, odd);
    }
    for (; i < stride; i += lanes()) {
      const V last = hn::LoadU(kTag, column + i);
      even = hn::MulAdd(last, last, even);
    }
    norms[q] = hn::GetLane(hn::SumOfLanes(kTag, hn::Add(even, odd)));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::gp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse::gp {

HWY_EXPORT(CorrelationMatrixKernel);
HWY_EXPORT(GradientSumsKernel);
HWY_EXPORT(CorrelateKernel);
HWY_EXPORT(SquaredNormsKernel);

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
void correlate(const double* scaled, Size n, Size dimensions, const double* weights, const double* queries, Size count,
               double* columns, double* means) {
  HWY_DYNAMIC_DISPATCH(CorrelateKernel)(scaled, n, dimensions, weights, queries, count, columns, means);
}
void squared_norms(const double* columns, Size n, Size count, double* norms) {
  HWY_DYNAMIC_DISPATCH(SquaredNormsKernel)(columns, n, count, norms);
}

}  // namespace rehearse::gp
#endif
