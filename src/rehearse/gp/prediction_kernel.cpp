#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/gp/prediction_kernel.cpp"
#include <type_traits>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include "rehearse/gp/correlation-inl.hpp"
#include "rehearse/gp/prediction_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::gp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Vectors of queries taken together: with kPanel rows they fill the registers, 24 of 32 with AVX-512, 12 of 16 before.
constexpr int kVectors = hn::MaxLanes(Tag()) == 8 ? 4 : 2;

static_assert(kVectors * static_cast<int>(hn::MaxLanes(Tag())) <= kGroup);

/// Calls group<vectors>(q) for groups that cover the queries 0 … rows − 1.
template <class Wide, class Narrow>
HWY_INLINE void for_each_group(Size rows, Wide wide, Narrow narrow) {
  Size q = 0;
  for (; rows - q > lanes(); q += kVectors * lanes()) wide(q);
  if (q < rows) narrow(q);
}

/// (z_i · z_q)² of a training point and a vector of queries.
HWY_INLINE V trend(const double* point, const double* queries, Size dimensions) {
  V product = hn::Zero(kTag);
  for (Size d = 0; d <= dimensions; ++d)
    product = hn::MulAdd(hn::LoadU(kTag, queries + d * kChunk), constant(point[d]), product);
  return hn::Mul(product, product);
}

/// Correlations of kCount training points with kWidth vectors of queries.
template <int kCount, int kWidth, bool kTrend>
HWY_INLINE void correlate_points(KernelPoints points, Size dimensions, const double* weights, KernelPoints queries,
                                 double* columns, V* means) {
  V squared[kCount][kWidth];
  for (int i = 0; i < kCount; ++i)
    for (int v = 0; v < kWidth; ++v) squared[i][v] = hn::Zero(kTag);
  for (Size d = 0; d < dimensions; ++d) {
    for (int i = 0; i < kCount; ++i) {
      const V point = constant(points.scaled[i * dimensions + d]);
      for (int v = 0; v < kWidth; ++v) {
        const V difference = hn::Sub(hn::LoadU(kTag, queries.scaled + d * kChunk + v * lanes()), point);
        squared[i][v] = hn::MulAdd(difference, difference, squared[i][v]);
      }
    }
  }
  for (int i = 0; i < kCount; ++i) {
    for (int v = 0; v < kWidth; ++v) {
      V c = correlation(squared[i][v]);
      means[v] = hn::MulAdd(c, constant(weights[i]), means[v]);
      if (!columns) continue;
      if (kTrend) c = hn::Add(c, trend(points.z + i * (dimensions + 1), queries.z + v * lanes(), dimensions));
      hn::StoreU(c, kTag, columns + (i * kWidth + v) * lanes());
    }
  }
}

template <int kWidth, bool kTrend>
HWY_INLINE void correlate_group(KernelPoints points, Size n, Size dimensions, const double* weights,
                                KernelPoints queries, double* columns, double* means) {
  V sums[kWidth];
  for (int v = 0; v < kWidth; ++v) sums[v] = hn::Zero(kTag);
  const auto from = [=](Size i) HWY_ATTR {
    return KernelPoints{points.scaled + i * dimensions, kTrend ? points.z + i * (dimensions + 1) : nullptr};
  };
  const auto column = [=](Size i) HWY_ATTR { return columns ? columns + i * kWidth * lanes() : nullptr; };
  Size i = 0;
  for (; i + 2 <= n; i += 2)
    correlate_points<2, kWidth, kTrend>(from(i), dimensions, weights + i, queries, column(i), sums);
  if (i < n) correlate_points<1, kWidth, kTrend>(from(i), dimensions, weights + i, queries, column(i), sums);
  for (int v = 0; v < kWidth; ++v) hn::StoreU(sums[v], kTag, means + v * lanes());
}

template <bool kTrend>
HWY_INLINE void correlate_all(KernelPoints points, Size n, Size dimensions, const double* weights, KernelPoints queries,
                              Size rows, double* columns, double* means) {
  const auto group = [=](auto width, Size q) HWY_ATTR {
    const KernelPoints these{queries.scaled + q, kTrend ? queries.z + q : nullptr};
    correlate_group<width, kTrend>(points, n, dimensions, weights, these, columns ? columns + q * n : nullptr,
                                   means + q);
  };
  for_each_group(
      rows, [&](Size q) HWY_ATTR { group(std::integral_constant<int, kVectors>(), q); },
      [&](Size q) HWY_ATTR { group(std::integral_constant<int, 1>(), q); });
}

void CorrelateKernel(KernelPoints points, Size n, Size dimensions, const double* weights, KernelPoints queries,
                     Size rows, double* columns, double* means) {
  if (points.z && columns)
    correlate_all<true>(points, n, dimensions, weights, queries, rows, columns, means);
  else
    correlate_all<false>(points, n, dimensions, weights, queries, rows, columns, means);
}

template <int kWidth>
HWY_INLINE void add_form(const double* form, Size dimensions, const double* queries, double* means) {
  V sums[kWidth];
  for (int v = 0; v < kWidth; ++v) sums[v] = hn::Add(hn::LoadU(kTag, means + v * lanes()), constant(*form));
  ++form;
  for (Size i = 0; i < dimensions; ++i) {
    V products[kWidth];
    for (int v = 0; v < kWidth; ++v) products[v] = constant(*form);
    ++form;
    for (Size j = 0; j <= i; ++j, ++form)
      for (int v = 0; v < kWidth; ++v)
        products[v] = hn::MulAdd(constant(*form), hn::LoadU(kTag, queries + j * kChunk + v * lanes()), products[v]);
    for (int v = 0; v < kWidth; ++v)
      sums[v] = hn::MulAdd(products[v], hn::LoadU(kTag, queries + i * kChunk + v * lanes()), sums[v]);
  }
  for (int v = 0; v < kWidth; ++v) hn::StoreU(sums[v], kTag, means + v * lanes());
}

void AddQuadraticFormKernel(const double* form, Size dimensions, const double* queries, Size rows, double* means) {
  for_each_group(
      rows, [&](Size q) HWY_ATTR { add_form<kVectors>(form, dimensions, queries + q, means + q); },
      [&](Size q) HWY_ATTR { add_form<1>(form, dimensions, queries + q, means + q); });
}

/// Adds to norms the squares of one panel's rows times kWidth vectors of columns, of which `length` entries count.
template <int kWidth>
HWY_INLINE void add_panel(const double* panel, Size length, const double* columns, double* norms) {
  V products[kPanel][kWidth];
  for (int r = 0; r < kPanel; ++r)
    for (int v = 0; v < kWidth; ++v) products[r][v] = hn::Zero(kTag);
  for (Size k = 0; k < length; ++k) {
    V column[kWidth];
    for (int v = 0; v < kWidth; ++v) column[v] = hn::LoadU(kTag, columns + (k * kWidth + v) * lanes());
    for (int r = 0; r < kPanel; ++r) {
      const V entry = constant(panel[k * kPanel + r]);
      for (int v = 0; v < kWidth; ++v) products[r][v] = hn::MulAdd(entry, column[v], products[r][v]);
    }
  }
  for (int v = 0; v < kWidth; ++v) {
    V norm = hn::LoadU(kTag, norms + v * lanes());
    for (int r = 0; r < kPanel; ++r) norm = hn::MulAdd(products[r][v], products[r][v], norm);
    hn::StoreU(norm, kTag, norms + v * lanes());
  }
}

void TriangularNormsKernel(const double* packed, Size n, const double* columns, Size rows, double* norms) {
  for (Size q = 0; q < kChunk; ++q) norms[q] = 0;
  for (Size first = 0; first < n; first += kPanel) {
    const Size length = first + kPanel < n ? first + kPanel : n;
    for_each_group(
        rows, [&](Size q) HWY_ATTR { add_panel<kVectors>(packed, length, columns + q * n, norms + q); },
        [&](Size q) HWY_ATTR { add_panel<1>(packed, length, columns + q * n, norms + q); });
    packed += kPanel * (first + kPanel);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::gp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse::gp {

HWY_EXPORT(CorrelateKernel);
HWY_EXPORT(AddQuadraticFormKernel);
HWY_EXPORT(TriangularNormsKernel);

void correlate(KernelPoints points, Size n, Size dimensions, const double* weights, KernelPoints queries, Size rows,
               double* columns, double* means) {
  HWY_DYNAMIC_DISPATCH(CorrelateKernel)(points, n, dimensions, weights, queries, rows, columns, means);
}
void add_quadratic_form(const double* form, Size dimensions, const double* queries, Size rows, double* means) {
  HWY_DYNAMIC_DISPATCH(AddQuadraticFormKernel)(form, dimensions, queries, rows, means);
}
void triangular_norms(const double* packed, Size n, const double* columns, Size rows, double* norms) {
  HWY_DYNAMIC_DISPATCH(TriangularNormsKernel)(packed, n, columns, rows, norms);
}

void pack_inverse_factor(const double* tiles, Size n, double* packed) {
  for (Size first = 0; first < n; first += kPanel)
    for (Size k = 0; k < first + kPanel; ++k)
      for (Size row = first; row < first + kPanel; ++row)
        *packed++ = row < n && k <= row ? tiles[transposed_offset(row, k)] : 0;
}

double packed_entry(const double* packed, Size row, Size column) {
  const Size panel = row / kPanel;
  return packed[kPanel * kPanel * panel * (panel + 1) / 2 + column * kPanel + row % kPanel];
}

}  // namespace rehearse::gp
#endif
