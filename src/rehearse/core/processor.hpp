#pragma once
// Requirements on the processor, so that results have the same bytes on each: docs/architecture.md, "Laws".

#include <string>

namespace rehearse {

/// Throws InvalidInput unless the processor has AVX2 and fused multiply-adds (most x86-64 since 2013). Also fixes the
/// sizes of the blocks of Eigen's products, which would follow the processor's caches and decide the order of sums.
/// Every evaluator calls it; a program that uses none calls it first. Cheap, any thread.
void require_processor();

/// The instruction set of vectorised kernels, "AVX3" or "AVX2", for benchmarks. It decides speed alone. The environment
/// variable REHEARSE_KERNELS=avx2 keeps them to AVX2, to compare; it is read once.
std::string kernel_target();

}  // namespace rehearse
