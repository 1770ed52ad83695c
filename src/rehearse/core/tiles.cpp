#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/core/tiles.cpp"
#include <algorithm>
#include <cmath>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include "rehearse/core/eight-inl.hpp"
#include "rehearse/core/tiles.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Vectors of rows and columns that `multiply` keeps in registers.
constexpr int kStrip = hn::MaxLanes(Tag()) == 8 ? 4 : 2;
constexpr int kColumns = 4;

/// Rows (and columns) of tile t that belong to the matrix.
HWY_INLINE Size tile_rows(Size n, Size t) { return std::min(kTile, n - t * kTile); }

/// The strides of a factor: entry B(m, c) is b[c * column + m * inner].
struct Strides {
  Size column, inner;
};
constexpr Strides kTransposed{1, kTile}, kPlain{kTile, 1};

template <int kHeight, bool kSubtract>
HWY_INLINE void multiply_strip(const double* a, const double* b, Strides stride, Size inner, double* c) {
  V sums[kColumns][kHeight];
  for (int j = 0; j < kColumns; ++j)
    for (int v = 0; v < kHeight; ++v) sums[j][v] = hn::LoadU(kTag, c + j * kTile + v * lanes());
  for (Size m = 0; m < inner; ++m) {
    V column[kHeight];
    for (int v = 0; v < kHeight; ++v) column[v] = hn::LoadU(kTag, a + m * kTile + v * lanes());
    for (int j = 0; j < kColumns; ++j) {
      const V entry = hn::Set(kTag, b[j * stride.column + m * stride.inner]);
      for (int v = 0; v < kHeight; ++v)
        sums[j][v] = kSubtract ? hn::NegMulAdd(column[v], entry, sums[j][v]) : hn::MulAdd(column[v], entry, sums[j][v]);
    }
  }
  for (int j = 0; j < kColumns; ++j)
    for (int v = 0; v < kHeight; ++v) hn::StoreU(sums[j][v], kTag, c + j * kTile + v * lanes());
}

/// C ± A B of tiles, `rows` × `inner` times `inner` × `columns`. Some more rows and columns of C become undefined.
template <bool kSubtract>
HWY_INLINE void multiply(const double* a, const double* b, Strides stride, Size rows, Size columns, Size inner,
                         double* c) {
  for (Size j = 0; j < columns; j += kColumns) {
    const double* bj = b + j * stride.column;
    double* cj = c + j * kTile;
    Size i = 0;
    for (; i + (kStrip - 1) * lanes() < rows; i += kStrip * lanes())
      multiply_strip<kStrip, kSubtract>(a + i, bj, stride, inner, cj + i);
    for (; i < rows; i += lanes()) multiply_strip<1, kSubtract>(a + i, bj, stride, inner, cj + i);
  }
}

HWY_INLINE void copy_tile(const double* from, double* to) { std::copy(from, from + kTile * kTile, to); }
HWY_INLINE void clear_tile(double* tile) { std::fill(tile, tile + kTile * kTile, 0.0); }

/// Column c of B − B(:, 0…c−1) L(c, 0…c−1)ᵀ, in place: what elimination leaves before the division by the pivot.
HWY_INLINE void eliminate(const double* factor, Size c, Size rows, double* b) {
  for (Size i = 0; i < rows; i += kStrip * lanes()) {
    V sums[kStrip];
    for (int v = 0; v < kStrip; ++v) sums[v] = hn::LoadU(kTag, b + c * kTile + i + v * lanes());
    for (Size m = 0; m < c; ++m) {
      const V entry = hn::Set(kTag, factor[m * kTile + c]);
      for (int v = 0; v < kStrip; ++v)
        sums[v] = hn::NegMulAdd(hn::LoadU(kTag, b + m * kTile + i + v * lanes()), entry, sums[v]);
    }
    for (int v = 0; v < kStrip; ++v) hn::StoreU(sums[v], kTag, b + c * kTile + i + v * lanes());
  }
}

HWY_INLINE void scale_column(double factor, double* column) {
  for (Size i = 0; i < kTile; i += lanes())
    hn::StoreU(hn::Mul(hn::LoadU(kTag, column + i), hn::Set(kTag, factor)), kTag, column + i);
}

HWY_INLINE bool factorise_diagonal(Size size, double* tile) {
  for (Size c = 0; c < size; ++c) {
    eliminate(tile, c, kTile, tile);
    const double pivot = tile[c * kTile + c];
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    scale_column(1 / std::sqrt(pivot), tile + c * kTile);
  }
  return true;
}

/// B ← B L⁻ᵀ.
HWY_INLINE void divide_by_diagonal(const double* factor, Size size, double* b) {
  for (Size c = 0; c < size; ++c) {
    eliminate(factor, c, kTile, b);
    scale_column(1 / factor[c * kTile + c], b + c * kTile);
  }
}

bool CholeskyKernel(Size n, double* tiles) {
  for (Size j = 0; j < tile_count(n); ++j) {
    double* diagonal = tiles + tile_offset(j, j);
    const Size columns = tile_rows(n, j);
    for (Size i = j; i < tile_count(n); ++i) {
      double* target = tiles + tile_offset(i, j);
      for (Size k = 0; k < j; ++k)
        multiply<true>(tiles + tile_offset(i, k), tiles + tile_offset(j, k), kTransposed, tile_rows(n, i), columns,
                       kTile, target);
      if (i > j)
        divide_by_diagonal(diagonal, columns, target);
      else if (!factorise_diagonal(columns, target))
        return false;
    }
  }
  return true;
}

/// y − A x for a tile.
HWY_INLINE void subtract_product(const double* a, const double* x, Size inner, double* y) {
  for (Size i = 0; i < kTile; i += kStrip * lanes()) {
    V sums[kStrip];
    for (int v = 0; v < kStrip; ++v) sums[v] = hn::LoadU(kTag, y + i + v * lanes());
    for (Size m = 0; m < inner; ++m)
      for (int v = 0; v < kStrip; ++v)
        sums[v] = hn::NegMulAdd(hn::LoadU(kTag, a + m * kTile + i + v * lanes()), hn::Set(kTag, x[m]), sums[v]);
    for (int v = 0; v < kStrip; ++v) hn::StoreU(sums[v], kTag, y + i + v * lanes());
  }
}

HWY_INLINE void divide_vector_by_diagonal(const double* diagonal, Size rows, double* x) {
  for (Size c = 0; c < rows; ++c) {
    x[c] /= diagonal[c * kTile + c];
    for (Size r = c + 1; r < rows; ++r) x[r] -= diagonal[c * kTile + r] * x[c];
  }
}

void SolveKernel(Size n, const double* tiles, Size columns, double* x) {
  const Size height = padded(n);
  for (Size i = 0; i < tile_count(n); ++i) {
    for (Size j = 0; j < i; ++j)
      for (Size c = 0; c < columns; ++c)
        subtract_product(tiles + tile_offset(i, j), x + c * height + j * kTile, kTile, x + c * height + i * kTile);
    for (Size c = 0; c < columns; ++c)
      divide_vector_by_diagonal(tiles + tile_offset(i, i), tile_rows(n, i), x + c * height + i * kTile);
  }
}

/// y − Aᵀ x for a tile of `rows` rows; x is zero past them.
HWY_INLINE void subtract_transposed_product(const double* a, const double* x, double* y) {
  for (Size c = 0; c < kTile; ++c) {
    V sums[kParts];
    for (V& sum : sums) sum = hn::Zero(kTag);
    for (Size i = 0; i < kTile; i += 8)
      for (int p = 0; p < kParts; ++p) {
        const Size row = i + p * lanes();
        sums[p] = hn::MulAdd(hn::LoadU(kTag, a + c * kTile + row), hn::LoadU(kTag, x + row), sums[p]);
      }
    y[c] -= sum_of_eight(sums);
  }
}

void SolveTransposedKernel(Size n, const double* tiles, double* x) {
  for (Size j = tile_count(n) - 1; j >= 0; --j) {
    double* xj = x + j * kTile;
    for (Size i = j + 1; i < tile_count(n); ++i)
      subtract_transposed_product(tiles + tile_offset(i, j), x + i * kTile, xj);
    const double* diagonal = tiles + tile_offset(j, j);
    for (Size c = tile_rows(n, j) - 1; c >= 0; --c) {
      for (Size r = c + 1; r < tile_rows(n, j); ++r) xj[c] -= diagonal[c * kTile + r] * xj[r];
      xj[c] /= diagonal[c * kTile + c];
    }
  }
}

/// tile ← L⁻ᵀ, upper, column by column; zero below.
HWY_INLINE void invert_diagonal(Size size, double* tile) {
  HWY_ALIGN double inverse[kTile * kTile];
  clear_tile(inverse);
  for (Size c = 0; c < size; ++c) {
    eliminate(tile, c, kTile, inverse);
    const double reciprocal = 1 / tile[c * kTile + c];
    scale_column(reciprocal, inverse + c * kTile);
    inverse[c * kTile + c] = reciprocal;
  }
  copy_tile(inverse, tile);
}

// With Y = L⁻ᵀ in tiles Y_ji, j ≤ i, kept where L_ij was: Y_ji = −(Σ_{j ≤ k < i} Y_jk L_ikᵀ) Y_ii. For each i, L_ij is
// no longer needed once Y_ji is known if j ascends.
void InvertFactorKernel(Size n, double* tiles) {
  HWY_ALIGN double sum[kTile * kTile];
  for (Size i = 0; i < tile_count(n); ++i) {
    const Size columns = tile_rows(n, i);
    double* diagonal = tiles + tile_offset(i, i);
    invert_diagonal(columns, diagonal);
    for (Size j = 0; j < i; ++j) {
      clear_tile(sum);
      for (Size k = j; k < i; ++k)
        multiply<false>(tiles + tile_offset(k, j), tiles + tile_offset(i, k), kTransposed, kTile, columns, kTile, sum);
      double* target = tiles + tile_offset(i, j);
      clear_tile(target);
      multiply<true>(sum, diagonal, kPlain, kTile, columns, columns, target);
    }
  }
}

// A⁻¹_ij = Σ_{k ≥ i} Y_ik Y_jkᵀ. Ascending i, and j up to i, needs no tile that was overwritten before.
void MultiplyInverseKernel(Size n, double* tiles) {
  HWY_ALIGN double sum[kTile * kTile];
  for (Size i = 0; i < tile_count(n); ++i) {
    for (Size j = 0; j <= i; ++j) {
      clear_tile(sum);
      for (Size k = i; k < tile_count(n); ++k)
        multiply<false>(tiles + tile_offset(k, i), tiles + tile_offset(k, j), kTransposed, tile_rows(n, i), kTile,
                        tile_rows(n, k), sum);
      copy_tile(sum, tiles + tile_offset(i, j));
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse {

HWY_EXPORT(CholeskyKernel);
HWY_EXPORT(SolveKernel);
HWY_EXPORT(SolveTransposedKernel);
HWY_EXPORT(InvertFactorKernel);
HWY_EXPORT(MultiplyInverseKernel);

bool tiles_cholesky(Size n, double* tiles) { return HWY_DYNAMIC_DISPATCH(CholeskyKernel)(n, tiles); }
void tiles_solve(Size n, const double* tiles, double* x, Size columns) {
  HWY_DYNAMIC_DISPATCH(SolveKernel)(n, tiles, columns, x);
}
void tiles_solve_transposed(Size n, const double* tiles, double* x) {
  HWY_DYNAMIC_DISPATCH(SolveTransposedKernel)(n, tiles, x);
}
void tiles_invert_factor(Size n, double* tiles) { HWY_DYNAMIC_DISPATCH(InvertFactorKernel)(n, tiles); }
void tiles_multiply_inverse(Size n, double* tiles) { HWY_DYNAMIC_DISPATCH(MultiplyInverseKernel)(n, tiles); }

}  // namespace rehearse
#endif
