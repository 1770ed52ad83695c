#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/core/product_kernel.cpp"
#include <algorithm>
#include <vector>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include "rehearse/core/eight-inl.hpp"
#include "rehearse/core/product_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Size = std::ptrdiff_t;

/// A register tile: kVectors vectors of rows by kColumns columns fill 27 of 32 registers of AVX-512, all 16 of AVX2.
constexpr int kVectors = 3;
constexpr int kColumns = kParts == 1 ? 8 : 4;
constexpr Size kRows = kVectors * 8 / kParts;

/// Blocks of A (rows × inner) stay in the second-level cache, those of B (inner × columns) in the third (Goto 2008).
constexpr Size kInner = 256, kRowBlock = 120, kColumnBlock = 512;
static_assert(kRowBlock % kRows == 0 && kColumnBlock % kColumns == 0);

/// `count` rows (or columns) of a factor as panels of `width`, one inner index after the other, padded with zeros.
HWY_INLINE void pack(const double* from, Size stride, Size inner_stride, Size count, Size inner, Size width,
                     double* to) {
  for (Size first = 0; first < count; first += width) {
    const Size here = std::min(width, count - first);
    const double* panel = from + first * stride;
    for (Size p = 0; p < inner; ++p, to += width) {
      const double* entries = panel + p * inner_stride;
      if (stride == 1 && here == width) {
        std::copy(entries, entries + width, to);
        continue;
      }
      for (Size i = 0; i < here; ++i) to[i] = entries[i * stride];
      std::fill(to + here, to + width, 0.0);
    }
  }
}

/// kRows rows of A: one inner index is `step` after the other.
struct Panel {
  const double* data;
  Size step;
};

template <Sign kSign>
HWY_INLINE void multiply_tile(Panel panel, const double* b, Size inner, double scale, double* c, Size stride) {
  V sums[kColumns][kVectors];
  for (int j = 0; j < kColumns; ++j)
    for (int v = 0; v < kVectors; ++v)
      sums[j][v] = hn::Mul(hn::Set(kTag, scale), hn::LoadU(kTag, c + j * stride + v * lanes()));
  const double* a = panel.data;
  for (Size p = 0; p < inner; ++p, a += panel.step, b += kColumns) {
    V rows[kVectors];
    for (int v = 0; v < kVectors; ++v) rows[v] = hn::LoadU(kTag, a + v * lanes());
    for (int j = 0; j < kColumns; ++j) {
      const V entry = hn::Set(kTag, b[j]);
      for (int v = 0; v < kVectors; ++v)
        sums[j][v] =
            kSign == Sign::minus ? hn::NegMulAdd(rows[v], entry, sums[j][v]) : hn::MulAdd(rows[v], entry, sums[j][v]);
    }
  }
  for (int j = 0; j < kColumns; ++j)
    for (int v = 0; v < kVectors; ++v) hn::StoreU(sums[j][v], kTag, c + j * stride + v * lanes());
}

/// A tile at the border of C, or on the diagonal of a lower triangle: by way of a whole one. diagonal: the row of the
/// tile on which the diagonal meets its first column; only entries on and below it are stored.
template <Sign kSign>
HWY_INLINE void multiply_border(Panel panel, const double* b, Size inner, double scale, double* c, Size stride,
                                Size rows, Size columns, Size diagonal) {
  HWY_ALIGN double tile[kRows * kColumns] = {};
  for (Size j = 0; j < columns; ++j) std::copy(c + j * stride, c + j * stride + rows, tile + j * kRows);
  multiply_tile<kSign>(panel, b, inner, scale, tile, kRows);
  for (Size j = 0; j < columns; ++j)
    for (Size i = std::max(Size{0}, diagonal + j); i < rows; ++i) c[j * stride + i] = tile[j * kRows + i];
}

/// Rows of A, the inner indices of a block: packed in panels; or where they are and, packed, what is left of them
/// behind the last whole panel.
struct Rows {
  HWY_INLINE Panel panel(Size i, Size m, Size inner) const {
    if (step == 0) return {packed + i * inner, kRows};
    return i + kRows <= m ? Panel{there + i, step} : Panel{packed, kRows};
  }

  const double* packed;
  const double* there = nullptr;
  Size step = 0;
};

/// One block of C; first_row: of C's, less its first column.
template <Sign kSign>
HWY_INLINE void multiply_block(Part part, Size m, Size n, Size inner, double scale, Size first_row, Rows a,
                               const double* b, double* c, Size stride) {
  for (Size j = 0; j < n; j += kColumns, b += kColumns * inner) {
    for (Size i = 0; i < m; i += kRows) {
      const Panel panel = a.panel(i, m, inner);
      const Size rows = std::min(kRows, m - i), columns = std::min(Size{kColumns}, n - j);
      const Size diagonal = part == Part::lower ? j - (first_row + i) : -kColumns;
      if (diagonal >= rows) continue;
      double* tile = c + j * stride + i;
      if (rows == kRows && columns == kColumns && diagonal <= 1 - kColumns)
        multiply_tile<kSign>(panel, b, inner, scale, tile, stride);
      else
        multiply_border<kSign>(panel, b, inner, scale, tile, stride, rows, columns, diagonal);
    }
  }
}

/// Few columns do not repay what it costs to copy the rows.
HWY_INLINE Rows take_rows(Factor A, Size rows, Size inner, Size n, double* packed) {
  constexpr Size kFew = 5 * kColumns;
  if (A.row != 1 || n > kFew) {
    pack(A.data, A.row, A.column, rows, inner, kRows, packed);
    return {packed};
  }
  const Size whole = rows / kRows * kRows;
  pack(A.data + whole, 1, A.column, rows - whole, inner, kRows, packed);
  return {packed, A.data, A.column};
}

template <Sign kSign>
HWY_INLINE void multiply(Part part, Size m, Size n, Size k, Factor A, Factor B, double* C, Size stride, double scale) {
  static thread_local std::vector<double> memory(static_cast<std::size_t>(kInner * (kRowBlock + kColumnBlock)));
  double *a = memory.data(), *b = a + kInner * kRowBlock;
  for (Size j = 0; j < n; j += kColumnBlock) {
    const Size columns = std::min(kColumnBlock, n - j);
    for (Size p = 0; p == 0 || p < k; p += kInner) {  // C is scaled even where there is nothing to add
      const Size inner = std::min(kInner, k - p);
      pack(B.data + p * B.row + j * B.column, B.column, B.row, columns, inner, kColumns, b);
      // The rows above a block's first column have nothing in the lower triangle.
      for (Size i = part == Part::lower ? j / kRowBlock * kRowBlock : 0; i < m; i += kRowBlock) {
        const Size rows = std::min(kRowBlock, m - i);
        const Rows taken = take_rows({A.data + i * A.row + p * A.column, A.row, A.column}, rows, inner, n, a);
        multiply_block<kSign>(part, rows, columns, inner, p == 0 ? scale : 1, i - j, taken, b, C + j * stride + i,
                              stride);
      }
    }
  }
}

void AddProductKernel(Sign sign, Part part, Size m, Size n, Size k, Factor A, Factor B, double* C, Size stride,
                      double scale) {
  if (sign == Sign::minus)
    multiply<Sign::minus>(part, m, n, k, A, B, C, stride, scale);
  else
    multiply<Sign::plus>(part, m, n, k, A, B, C, stride, scale);
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse {

HWY_EXPORT(AddProductKernel);

void add_product(Sign sign, Part part, std::ptrdiff_t m, std::ptrdiff_t n, std::ptrdiff_t k, Factor A, Factor B,
                 double* C, std::ptrdiff_t stride, double scale) {
  HWY_DYNAMIC_DISPATCH(AddProductKernel)(sign, part, m, n, k, A, B, C, stride, scale);
}

}  // namespace rehearse
#endif
