#pragma once
// The product of dense matrices that everything in linear_algebra.hpp rests on. Vectorised by Highway; raw pointers;
// may run concurrently.

#include <cstddef>

namespace rehearse {

/// Entry (i, j) of a factor stands at data[i * row + j * column]: the transposed factor has the strides exchanged.
struct Factor {
  const double* data;
  std::ptrdiff_t row, column;
};

enum class Sign { plus, minus };

/// The entries of a result that are computed; others keep their values.
enum class Part { all, lower };

/// C (m × n, column-major with `stride`) ← scale·C ± A B, A: m × k, B: k × n. Every entry is one chain of fused
/// multiply-adds that begins with C's and takes the inner index in ascending order: its bits depend neither on the
/// sizes of blocks nor on the processor.
void add_product(Sign sign, Part part, std::ptrdiff_t m, std::ptrdiff_t n, std::ptrdiff_t k, Factor A, Factor B,
                 double* C, std::ptrdiff_t stride, double scale = 1);

}  // namespace rehearse
