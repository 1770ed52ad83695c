#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/policy/layer_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include <hwy/contrib/math/math-inl.h>

#include "rehearse/core/elementary-inl.hpp"
#include "rehearse/policy/layer_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::policy {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;

/// One output of one block of rows.
HWY_INLINE hn::Vec<D> unit(D d, const double* weights, Index weight_stride, const double* in, Index in_stride,
                           Index inputs) {
  auto sum = hn::LoadU(d, weights + inputs * weight_stride);
  for (Index i = 0; i < inputs; ++i)
    sum = hn::MulAdd(hn::LoadU(d, weights + i * weight_stride), hn::LoadU(d, in + i * in_stride), sum);
  return sum;
}

void LayerKernel(const double* weights, Index weight_stride, const double* in, Index in_stride, Index inputs,
                 double* out, Index out_stride, Index outputs, Index rows, bool tanh) {
  const D d;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  const auto activate = [&](auto a) HWY_ATTR { return tanh ? rehearse::HWY_NAMESPACE::hyperbolic_tangent(d, a) : a; };
  Index row = 0;
  for (; row + lanes <= rows; row += lanes)
    for (Index o = 0; o < outputs; ++o) {
      const auto a =
          unit(d, weights + o * (inputs + 1) * weight_stride + row, weight_stride, in + row, in_stride, inputs);
      hn::StoreU(activate(a), d, out + o * out_stride + row);
    }
  HWY_ALIGN double tail[HWY_MAX_BYTES / sizeof(double)] = {};
  for (Index o = 0; row < rows && o < outputs; ++o) {
    const double* w = weights + o * (inputs + 1) * weight_stride;
    for (Index r = row; r < rows; ++r) {
      // The same rounding as in the vector code, so that a row does not depend on its place in the batch.
      hn::CappedTag<double, 1> d1;
      auto sum = hn::LoadU(d1, w + inputs * weight_stride + r);
      for (Index i = 0; i < inputs; ++i)
        sum = hn::MulAdd(hn::LoadU(d1, w + i * weight_stride + r), hn::LoadU(d1, in + i * in_stride + r), sum);
      hn::StoreU(sum, d1, tail + (r - row));
    }
    hn::Store(activate(hn::Load(d, tail)), d, tail);
    for (Index r = row; r < rows; ++r) out[o * out_stride + r] = tail[r - row];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::policy
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse::policy {

HWY_EXPORT(LayerKernel);

void layer(const double* weights, Index weight_stride, const double* in, Index in_stride, Index inputs, double* out,
           Index out_stride, Index outputs, Index rows, bool tanh) {
  HWY_DYNAMIC_DISPATCH(LayerKernel)
  (weights, weight_stride, in, in_stride, inputs, out, out_stride, outputs, rows, tanh);
}

}  // namespace rehearse::policy
#endif
