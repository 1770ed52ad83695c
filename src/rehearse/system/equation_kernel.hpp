// An equation, written once with ordinary operators, as an OdeKernel for each instruction set. A source file includes
// it once, and names the file of the equation before:
//
//   #define REHEARSE_EQUATION "rehearse/robots/NAME/equation.hpp"
//   #include "rehearse/system/equation_kernel.hpp"
//
// Then system::equation_kernel() is its kernel. The file includes nothing and opens no namespace: it is compiled within
// this one, for each instruction set anew. It holds
//
//   struct Equation {
//     static constexpr int kStates = 4, kActions = 2, kParameters = 3;
//     static constexpr int kAngles[] = {3};                     // if states are angles: their sin and cos are cheap
//     explicit Equation(const double* phi);                     // what depends on parameters alone
//     void operator()(const auto& x, const auto* u, auto* dxdt) const;
//   };
//
// x[i], u[i] and dxdt[i] are numbers with + - * /, mul_add(a, b, c) = a b + c and neg_mul_add(a, b, c) = c − a b
// rounded once, sin, cos, exp, tanh, sqrt and abs: Pack of pack-inl.hpp. With `static constexpr bool kIntegrateSines =
// true` sines and cosines of angles are integrated with the state: cheaper, and as exact as the steps.

#ifndef REHEARSE_EQUATION
#error "define REHEARSE_EQUATION as the path of the file of the equation"
#endif
#ifndef HWY_BASELINE_TARGETS
#define HWY_BASELINE_TARGETS HWY_AVX2
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rehearse/system/equation_kernel.hpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Highway's order matters: the functions come after the target.
#include "rehearse/system/ode.hpp"
#include "rehearse/system/ode_kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::system {
namespace HWY_NAMESPACE {
namespace {

#include REHEARSE_EQUATION

// Flattened: an equation is fast where it is inlined.
HWY_FLATTEN void DerivativeKernel(const double* x, const double* u, const double* phi, double* dxdt) {
  slope_of_row<Equation>(x, u, phi, dxdt);
}

HWY_FLATTEN void ChangeKernel(const Batch& batch, const double* phi, double duration_s, Index steps) {
  change_rows<Equation>(batch, phi, duration_s, steps);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace rehearse::system
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rehearse::system {
namespace {

HWY_EXPORT(DerivativeKernel);
HWY_EXPORT(ChangeKernel);

// Dispatched at each call: the address of a dispatched function is, before its first call, that of Highway's chooser,
// which asks the processor for its instruction sets every time.
void derivative(const double* x, const double* u, const double* phi, double* dxdt) {
  HWY_DYNAMIC_DISPATCH(DerivativeKernel)(x, u, phi, dxdt);
}

void change(const ConstMatrixView& X, const ConstMatrixView& U, const double* phi, double duration_s, Index steps,
            MatrixView dX) {
  const Batch batch{X.data(), X.outerStride(), U.data(), U.outerStride(), dX.data(), dX.outerStride(), X.rows()};
  HWY_DYNAMIC_DISPATCH(ChangeKernel)(batch, phi, duration_s, steps);
}

OdeKernel equation_kernel() {
  using HWY_NAMESPACE::Equation;
  return {.states = Equation::kStates,
          .actions = Equation::kActions,
          .parameters = Equation::kParameters,
          .derivative = derivative,
          .change = change};
}

}  // namespace
}  // namespace rehearse::system
#endif
