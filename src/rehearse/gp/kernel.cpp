#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/gp/kernel.cpp"
#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include "rehearse/gp/correlation-inl.hpp"
#include "rehearse/gp/kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::gp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kStrip = 4;  // vectors of rows taken together

/// Correlations of kHeight vectors of points with one point; coordinates are kTile apart.
template <int kHeight>
HWY_INLINE void correlations(const double* rows, const double* point, Size dimensions, V* out) {
  V squared[kHeight];
  for (int v = 0; v < kHeight; ++v) squared[v] = hn::Zero(kTag);
  for (Size d = 0; d < dimensions; ++d) {
    const V center = constant(point[d * kTile]);
    for (int v = 0; v < kHeight; ++v) {
      const V difference = hn::Sub(hn::LoadU(kTag, rows + d * kTile + v * lanes()), center);
      squared[v] = hn::MulAdd(difference, difference, squared[v]);
    }
  }
  for (int v = 0; v < kHeight; ++v) out[v] = correlation(squared[v]);
}

void CorrelationMatrixKernel(const double* scaled, Size n, Size dimensions, double diagonal, double* tiles) {
  for (Size i = 0; i < tile_count(n); ++i) {
    const double* rows = scaled + i * kTile * dimensions;
    for (Size k = 0; k < (i + 1) * kTile; ++k) {
      const Size j = k / kTile, c = k % kTile;
      double* column = tiles + tile_offset(i, j) + c * kTile;
      for (Size r = 0; r < kTile; r += kStrip * lanes()) {
        V out[kStrip];
        correlations<kStrip>(rows + r, scaled + j * kTile * dimensions + c, dimensions, out);
        for (int v = 0; v < kStrip; ++v) hn::StoreU(out[v], kTag, column + r + v * lanes());
      }
      if (i == j) column[c] = diagonal;
    }
  }
}

template <int kHeight>
HWY_INLINE void products(const double* rows, const double* point, Size dimensions, V* out) {
  for (int v = 0; v < kHeight; ++v) out[v] = hn::Zero(kTag);
  for (Size d = 0; d < dimensions; ++d)
    for (int v = 0; v < kHeight; ++v)
      out[v] = hn::MulAdd(hn::LoadU(kTag, rows + d * kTile + v * lanes()), constant(point[d * kTile]), out[v]);
}

void AddTrendKernel(const double* z, Size n, Size dimensions, double* tiles) {
  for (Size i = 0; i < tile_count(n); ++i) {
    const double* rows = z + i * kTile * dimensions;
    for (Size k = 0; k < std::min(n, (i + 1) * kTile); ++k) {
      const Size j = k / kTile, c = k % kTile;
      double* column = tiles + tile_offset(i, j) + c * kTile;
      for (Size r = 0; r < kTile; r += kStrip * lanes()) {
        V s[kStrip];
        products<kStrip>(rows + r, z + j * kTile * dimensions + c, dimensions, s);
        for (int v = 0; v < kStrip; ++v) {
          double* entry = column + r + v * lanes();
          hn::StoreU(hn::MulAdd(s[v], s[v], hn::LoadU(kTag, entry)), kTag, entry);
        }
      }
    }
  }
}

/// Every pair counts twice in the tiles below the diagonal. In those on it entries above the diagonal are missing:
/// those below count twice and the diagonal once.
void TrendGradientSumsKernel(const double* z, Size n, Size dimensions, const double* b, const double* inverse,
                             double* sums) {
  std::fill(sums, sums + 8 * dimensions, 0.0);
  for (Size i = 0; i < tile_count(n); ++i) {
    const double* rows = z + i * kTile * dimensions;
    for (Size k = 0; k < std::min(n, (i + 1) * kTile); ++k) {
      const Size j = k / kTile, c = k % kTile;
      const double* point = z + j * kTile * dimensions + c;
      const double* column = inverse + tile_offset(i, j) + c * kTile;
      for (Size r = i > j ? 0 : c / lanes() * lanes(); r < kTile; r += lanes()) {
        V w;
        products<1>(rows + r, point, dimensions, &w);
        const V bb = hn::Mul(hn::LoadU(kTag, b + i * kTile + r), constant(b[k]));
        w = hn::Mul(w, hn::Sub(bb, hn::LoadU(kTag, column + r)));
        V twice = hn::Add(w, w);
        if (i == j && r <= c) {
          twice = hn::IfThenElse(hn::FirstN(kTag, static_cast<size_t>(c + 1 - r)), w, twice);
          twice = hn::IfThenZeroElse(hn::FirstN(kTag, static_cast<size_t>(c - r)), twice);
        }
        for (Size d = 0; d < dimensions; ++d) {
          const V zz = hn::Mul(hn::LoadU(kTag, rows + d * kTile + r), constant(point[d * kTile]));
          double* sum = sums + 8 * d + place_in_eight(r);
          hn::StoreU(hn::MulAdd(twice, zz, hn::LoadU(kTag, sum)), kTag, sum);
        }
      }
    }
  }
  for (Size d = 0; d < dimensions; ++d) sums[d] = sum_of_eight(sums + 8 * d);
}

/// Adds to the sums kHeight vectors of rows of column c of a tile, the first beginning at row r. kDiagonal: only
/// the rows below c count, of which the first vector begins at row r.
template <int kHeight, bool kDiagonal>
HWY_INLINE void add_to_sums(const double* rows, const double* point, Size dimensions, const double* b, double b_column,
                            const double* inverse, Size r, Size c, double* sums) {
  V w[kHeight], totals[kParts];
  double* last = sums + 8 * dimensions + place_in_eight(r);
  constexpr int kSums = std::min(kHeight, kParts);  // vectors of rows that are added to sums of their own
  for (int p = 0; p < kSums; ++p) totals[p] = hn::LoadU(kTag, last + p * lanes());
  correlations<kHeight>(rows, point, dimensions, w);
  for (int v = 0; v < kHeight; ++v) {
    const V bb = hn::Mul(hn::LoadU(kTag, b + v * lanes()), constant(b_column));
    w[v] = hn::Mul(w[v], hn::Sub(bb, hn::LoadU(kTag, inverse + v * lanes())));
    if (kDiagonal && r <= c) w[v] = hn::IfThenZeroElse(hn::FirstN(kTag, static_cast<size_t>(c + 1 - r)), w[v]);
    totals[v % kSums] = hn::Add(totals[v % kSums], w[v]);
  }
  for (int p = 0; p < kSums; ++p) hn::StoreU(totals[p], kTag, last + p * lanes());
  for (Size d = 0; d < dimensions; ++d) {
    double* to = sums + 8 * d + place_in_eight(r);
    V sum[kSums];
    for (int p = 0; p < kSums; ++p) sum[p] = hn::LoadU(kTag, to + p * lanes());
    for (int v = 0; v < kHeight; ++v) {
      const V difference = hn::Sub(hn::LoadU(kTag, rows + d * kTile + v * lanes()), constant(point[d * kTile]));
      sum[v % kSums] = hn::MulAdd(hn::Mul(w[v], difference), difference, sum[v % kSums]);
    }
    for (int p = 0; p < kSums; ++p) hn::StoreU(sum[p], kTag, to + p * lanes());
  }
}

void GradientSumsKernel(const double* scaled, Size n, Size dimensions, const double* b, const double* inverse,
                        double* sums) {
  std::fill(sums, sums + 8 * (dimensions + 1), 0.0);
  for (Size i = 0; i < tile_count(n); ++i) {
    const double* rows = scaled + i * kTile * dimensions;
    const double* bi = b + i * kTile;
    for (Size k = 0; k < std::min(n, (i + 1) * kTile); ++k) {
      const Size j = k / kTile, c = k % kTile;
      const double* point = scaled + j * kTile * dimensions + c;
      const double* column = inverse + tile_offset(i, j) + c * kTile;
      if (i > j) {
        for (Size r = 0; r < kTile; r += kStrip * lanes())
          add_to_sums<kStrip, false>(rows + r, point, dimensions, bi + r, b[k], column + r, r, c, sums);
      } else {
        for (Size r = c / lanes() * lanes(); r < kTile; r += lanes())
          add_to_sums<1, true>(rows + r, point, dimensions, bi + r, b[k], column + r, r, c, sums);
      }
    }
  }
  for (Size d = 0; d <= dimensions; ++d) sums[d] = sum_of_eight(sums + 8 * d);
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::gp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse::gp {

HWY_EXPORT(CorrelationMatrixKernel);
HWY_EXPORT(GradientSumsKernel);
HWY_EXPORT(AddTrendKernel);
HWY_EXPORT(TrendGradientSumsKernel);

void scale_inputs(const double* unit, Size n, Size dimensions, const double* factors, double* scaled) {
  constexpr double kFarAway = 1e100;
  for (Size i = 0; i < padded(n); ++i)
    for (Size d = 0; d < dimensions; ++d)
      scaled[(i / kTile * dimensions + d) * kTile + i % kTile] = i < n ? unit[d * n + i] * factors[d] : kFarAway;
}
void trend_inputs(const double* unit, const double* centers, const double* half_ranges, Size n, Size dimensions,
                  const double* factors, double* z) {
  const auto at = [=](Size i, Size d) -> double& { return z[(i / kTile * (dimensions + 1) + d) * kTile + i % kTile]; };
  for (Size i = 0; i < padded(n); ++i) {
    at(i, 0) = i < n ? factors[0] : 0;
    for (Size d = 0; d < dimensions; ++d)
      at(i, d + 1) = i < n ? (unit[d * n + i] * half_ranges[d] + centers[d]) * factors[d + 1] : 0;
  }
}
void correlation_matrix(const double* scaled, Size n, Size dimensions, double diagonal, double* tiles) {
  HWY_DYNAMIC_DISPATCH(CorrelationMatrixKernel)(scaled, n, dimensions, diagonal, tiles);
}
void add_trend(const double* z, Size n, Size dimensions, double* tiles) {
  HWY_DYNAMIC_DISPATCH(AddTrendKernel)(z, n, dimensions, tiles);
}
void trend_gradient_sums(const double* z, Size n, Size dimensions, const double* b, const double* inverse,
                         double* sums) {
  HWY_DYNAMIC_DISPATCH(TrendGradientSumsKernel)(z, n, dimensions, b, inverse, sums);
}
void gradient_sums(const double* scaled, Size n, Size dimensions, const double* b, const double* inverse,
                   double* sums) {
  HWY_DYNAMIC_DISPATCH(GradientSumsKernel)(scaled, n, dimensions, b, inverse, sums);
}

}  // namespace rehearse::gp
#endif
