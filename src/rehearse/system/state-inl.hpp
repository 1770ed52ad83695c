// The state that an equation sees. Included once for each instruction set.

#if defined(REHEARSE_SYSTEM_STATE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef REHEARSE_SYSTEM_STATE_INL_HPP
#undef REHEARSE_SYSTEM_STATE_INL_HPP
#else
#define REHEARSE_SYSTEM_STATE_INL_HPP
#endif

#include <array>

#include <hwy/highway.h>

#include "rehearse/core/types.hpp"

HWY_BEFORE_NAMESPACE();
namespace rehearse::system {
namespace HWY_NAMESPACE {

template <class Equation>
constexpr auto angles_of() {
  if constexpr (requires { Equation::kAngles; })
    return std::to_array(Equation::kAngles);
  else
    return std::array<int, 0>{};
}

/// The states that are angles: Equation::kAngles, or none.
template <class Equation>
constexpr auto kAnglesOf = angles_of<Equation>();
template <class Equation>
constexpr int kAngleCount = static_cast<int>(kAnglesOf<Equation>.size());

/// True if sines and cosines of the angles are integrated with the state, not turned along: Equation::kIntegrateSines.
template <class Equation>
constexpr bool kIntegratesSines = requires {
  requires Equation::kIntegrateSines;
};

/// One variable of a state: a number which, if it is an angle, brings its sine and cosine.
template <class Number>
class Variable : public Number {
 public:
  HWY_INLINE Variable(Number value, const Number* trig) : Number(value), trig_(trig) {}

  friend HWY_INLINE Number sin(const Variable& x) { return x.trig_ ? x.trig_[0] : sin(Number(x)); }
  friend HWY_INLINE Number cos(const Variable& x) { return x.trig_ ? x.trig_[1] : cos(Number(x)); }

 private:
  const Number* trig_;  // sine and cosine; null: compute them
};

/// All variables of a state.
template <class Equation, class Number>
class State {
 public:
  /// x: kStates numbers; trig: sine and cosine of each angle.
  HWY_INLINE State(const Number* x, const Number* trig) : x_(x), trig_(trig) {}

  HWY_INLINE Variable<Number> operator[](int i) const {
    for (Index a = 0; a < kAngleCount<Equation>; ++a)
      if (kAnglesOf<Equation>[a] == i) return {x_[i], trig_ + 2 * a};
    return {x_[i], nullptr};
  }

 private:
  const Number* x_;
  const Number* trig_;
};

/// Sine and cosine of each angle of x.
template <class Equation, class Number>
HWY_INLINE void sines_and_cosines(const Number* x, Number* trig) {
  for (const int angle : kAnglesOf<Equation>) {
    *trig++ = sin(x[angle]);
    *trig++ = cos(x[angle]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rehearse::system
HWY_AFTER_NAMESPACE();
#endif
