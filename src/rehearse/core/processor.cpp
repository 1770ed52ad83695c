#include "rehearse/core/processor.hpp"

#include <cstdlib>
#include <string_view>

#include <Eigen/Core>
#include <fmt/format.h>
#include <hwy/highway.h>

#include "rehearse/core/errors.hpp"

namespace rehearse {
namespace {

constexpr std::int64_t kWide = HWY_AVX3 | HWY_AVX3_DL;

void restrict_kernels() {
  const char* asked = std::getenv("REHEARSE_KERNELS");
  if (!asked || std::string_view(asked).empty()) return;
  if (std::string_view(asked) != "avx2")
    throw InvalidInput(fmt::format("REHEARSE_KERNELS = '{}', must be avx2 or not set", asked));
  hwy::DisableTargets(kWide);
}

void prepare() {
  if ((hwy::SupportedTargets() & (HWY_AVX2 | kWide)) == 0)
    throw InvalidInput(
        "this processor lacks AVX2 or fused multiply-adds (FMA), which Rehearse needs; most x86-64 processors since "
        "2013 have them");
  restrict_kernels();
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  constexpr std::ptrdiff_t kFirst = 32 << 10, kSecond = 256 << 10, kThird = 2 << 20;  // bytes; Eigen's own defaults
  Eigen::setCpuCacheSizes(kFirst, kSecond, kThird);
}

}  // namespace

void require_processor() {
  static const bool done = (prepare(), true);
  static_cast<void>(done);
}

std::string kernel_target() {
  require_processor();
  return hwy::TargetName((hwy::SupportedTargets() & kWide) != 0 ? HWY_AVX3 : HWY_AVX2);
}

}  // namespace rehearse
