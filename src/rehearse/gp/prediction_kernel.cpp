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

/// z_i · z_q of a training point and a vector of queries.
HWY_INLINE V trend_product(const double* point, const double* queries, Size dimensions) {
  V product = hn::Zero(kTag);
  for (Size d = 0; d <= dimensions; ++d)
    product = hn::MulAdd(hn::LoadU(kTag, queries + d * kChunk), constant(point[d]), product);
  return product;
}

HWY_INLINE V trend(const double* point, const double* queries, Size dimensions) {
  const V product = trend_product(point, queries, dimensions);
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

/// Adds to norms the squares of one panel's rows times kWidth vectors of columns, of which `length` entries count, and
/// to `solved`, unless it is null, the panel's transpose times these products.
template <int kWidth>
HWY_INLINE void add_panel(const double* panel, Size length, const double* columns, double* norms, double* solved) {
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
  for (Size k = 0; solved && k < length; ++k) {
    V sums[kWidth];
    for (int v = 0; v < kWidth; ++v) sums[v] = hn::LoadU(kTag, solved + (k * kWidth + v) * lanes());
    for (int r = 0; r < kPanel; ++r) {
      const V entry = constant(panel[k * kPanel + r]);
      for (int v = 0; v < kWidth; ++v) sums[v] = hn::MulAdd(entry, products[r][v], sums[v]);
    }
    for (int v = 0; v < kWidth; ++v) hn::StoreU(sums[v], kTag, solved + (k * kWidth + v) * lanes());
  }
}

void TriangularKernel(const double* packed, Size n, const double* columns, Size rows, double* norms, double* solved) {
  for (Size q = 0; q < kChunk; ++q) norms[q] = 0;
  for (Size i = 0; solved && i < n * kChunk; ++i) solved[i] = 0;
  const auto of = [=](double* numbers, Size q) HWY_ATTR { return numbers ? numbers + q * n : nullptr; };
  for (Size first = 0; first < n; first += kPanel) {
    const Size length = first + kPanel < n ? first + kPanel : n;
    for_each_group(
        rows, [&](Size q) HWY_ATTR { add_panel<kVectors>(packed, length, columns + q * n, norms + q, of(solved, q)); },
        [&](Size q) HWY_ATTR { add_panel<1>(packed, length, columns + q * n, norms + q, of(solved, q)); });
    packed += kPanel * (first + kPanel);
  }
}

/// Correlations become their products with the weights, solutions those with the correlations, and trends the products
/// of the solutions with z_i · z_q.
template <int kWidth, bool kSolved, bool kTrend>
HWY_INLINE void weigh(const double* z, Size n, Size dimensions, const double* weights, const double* queries,
                      PointColumns columns) {
  for (Size i = 0; i < n; ++i)
    for (int v = 0; v < kWidth; ++v) {
      const Size at = (i * kWidth + v) * lanes();
      V c = hn::LoadU(kTag, columns.correlations + at);
      if constexpr (kSolved) {
        const V solved = hn::LoadU(kTag, columns.solved + at);
        if constexpr (kTrend) {
          const V product = trend_product(z + i * (dimensions + 1), queries + v * lanes(), dimensions);
          c = hn::NegMulAdd(product, product, c);
          hn::StoreU(hn::Mul(solved, product), kTag, columns.trends + at);
        }
        hn::StoreU(hn::Mul(solved, c), kTag, columns.solved + at);
      }
      hn::StoreU(hn::Mul(constant(weights[i]), c), kTag, columns.correlations + at);
    }
}

/// sums[q] = Σ_i a_qi (x_id − x_qd) for one d, and the same of a second column unless it is null.
template <int kWidth, bool kSolved>
HWY_INLINE void sum_differences(const double* points, Size n, Size dimensions, const double* queries,
                                PointColumns columns, double* first, double* second) {
  V sums[2][kWidth], query[kWidth];
  for (int v = 0; v < kWidth; ++v) {
    sums[0][v] = sums[1][v] = hn::Zero(kTag);
    query[v] = hn::LoadU(kTag, queries + v * lanes());
  }
  for (Size i = 0; i < n; ++i) {
    const V point = constant(points[i * dimensions]);
    for (int v = 0; v < kWidth; ++v) {
      const Size at = (i * kWidth + v) * lanes();
      const V difference = hn::Sub(point, query[v]);
      sums[0][v] = hn::MulAdd(hn::LoadU(kTag, columns.correlations + at), difference, sums[0][v]);
      if constexpr (kSolved) sums[1][v] = hn::MulAdd(hn::LoadU(kTag, columns.solved + at), difference, sums[1][v]);
    }
  }
  for (int v = 0; v < kWidth; ++v) {
    hn::StoreU(sums[0][v], kTag, first + v * lanes());
    if constexpr (kSolved) hn::StoreU(sums[1][v], kTag, second + v * lanes());
  }
}

/// sums[q] = Σ_i u_qi z_id for one d.
template <int kWidth>
HWY_INLINE void sum_trends(const double* z, Size n, Size dimensions, const double* trends, double* sums) {
  V total[kWidth];
  for (int v = 0; v < kWidth; ++v) total[v] = hn::Zero(kTag);
  for (Size i = 0; i < n; ++i) {
    const V point = constant(z[i * (dimensions + 1)]);
    for (int v = 0; v < kWidth; ++v)
      total[v] = hn::MulAdd(hn::LoadU(kTag, trends + (i * kWidth + v) * lanes()), point, total[v]);
  }
  for (int v = 0; v < kWidth; ++v) hn::StoreU(total[v], kTag, sums + v * lanes());
}

template <bool kSolved, bool kTrend>
HWY_INLINE void sum_all(KernelPoints points, Size n, Size dimensions, const double* weights, KernelPoints queries,
                        Size rows, PointColumns columns, PointSums sums) {
  const auto group = [=](auto width, Size q) HWY_ATTR {
    const PointColumns these{columns.correlations + q * n, kSolved ? columns.solved + q * n : nullptr,
                             kTrend ? columns.trends + q * n : nullptr};
    weigh<width, kSolved, kTrend>(points.z, n, dimensions, weights, kTrend ? queries.z + q : nullptr, these);
    for (Size d = 0; d < dimensions; ++d)
      sum_differences<width, kSolved>(points.scaled + d, n, dimensions, queries.scaled + d * kChunk + q, these,
                                      sums.mean + d * kChunk + q, kSolved ? sums.variance + d * kChunk + q : nullptr);
    for (Size d = 0; kTrend && d <= dimensions; ++d)
      sum_trends<width>(points.z + d, n, dimensions, these.trends, sums.trend + d * kChunk + q);
  };
  for_each_group(
      rows, [&](Size q) HWY_ATTR { group(std::integral_constant<int, kVectors>(), q); },
      [&](Size q) HWY_ATTR { group(std::integral_constant<int, 1>(), q); });
}

void SumSlopesKernel(KernelPoints points, Size n, Size dimensions, const double* weights, KernelPoints queries,
                     Size rows, PointColumns columns, PointSums sums) {
  if (!columns.solved)
    sum_all<false, false>(points, n, dimensions, weights, queries, rows, columns, sums);
  else if (!columns.trends)
    sum_all<true, false>(points, n, dimensions, weights, queries, rows, columns, sums);
  else
    sum_all<true, true>(points, n, dimensions, weights, queries, rows, columns, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::gp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse::gp {

HWY_EXPORT(CorrelateKernel);
HWY_EXPORT(AddQuadraticFormKernel);
HWY_EXPORT(TriangularKernel);
HWY_EXPORT(SumSlopesKernel);

void correlate(KernelPoints points, Size n, Size dimensions, const double* weights, KernelPoints queries, Size rows,
               double* columns, double* means) {
  HWY_DYNAMIC_DISPATCH(CorrelateKernel)(points, n, dimensions, weights, queries, rows, columns, means);
}
void add_quadratic_form(const double* form, Size dimensions, const double* queries, Size rows, double* means) {
  HWY_DYNAMIC_DISPATCH(AddQuadraticFormKernel)(form, dimensions, queries, rows, means);
}
void triangular_norms(const double* packed, Size n, const double* columns, Size rows, double* norms) {
  HWY_DYNAMIC_DISPATCH(TriangularKernel)(packed, n, columns, rows, norms, nullptr);
}
void triangular_solutions(const double* packed, Size n, const double* columns, Size rows, double* norms,
                          double* solved) {
  HWY_DYNAMIC_DISPATCH(TriangularKernel)(packed, n, columns, rows, norms, solved);
}
void sum_slopes(KernelPoints points, Size n, Size dimensions, const double* weights, KernelPoints queries, Size rows,
                PointColumns columns, PointSums sums) {
  HWY_DYNAMIC_DISPATCH(SumSlopesKernel)(points, n, dimensions, weights, queries, rows, columns, sums);
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
