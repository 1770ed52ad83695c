#include "rehearse/expression/scalar.hpp"

#include <cmath>

namespace rehearse::expression {
namespace {

/// A comparison with NaN has no answer.
double truth(bool holds, double a, double b) { return std::isnan(a) || std::isnan(b) ? NAN : holds ? 1 : 0; }

double of_one(Op op, double a) {
  switch (op) {
    case Op::negate:
      return -a;
    case Op::sine:
      return std::sin(a);
    case Op::cosine:
      return std::cos(a);
    case Op::tangent:
      return std::tan(a);
    case Op::arcsine:
      return std::asin(a);
    case Op::arccosine:
      return std::acos(a);
    case Op::arctangent:
      return std::atan(a);
    case Op::hyperbolic_sine:
      return std::sinh(a);
    case Op::hyperbolic_cosine:
      return std::cosh(a);
    case Op::hyperbolic_tangent:
      return std::tanh(a);
    case Op::exponential:
      return std::exp(a);
    case Op::logarithm:
      return std::log(a);
    case Op::square_root:
      return std::sqrt(a);
    case Op::absolute:
      return std::abs(a);
    case Op::sign:
      return a > 0 ? 1 : a < 0 ? -1 : a;
    case Op::round_down:
      return std::floor(a);
    case Op::round_up:
      return std::ceil(a);
    default:
      return truth(a == 0, a, a);  // logical_not
  }
}

double smaller(double a, double b) { return std::isnan(a) || a < b ? a : b; }

double of_two(Op op, double a, double b) {
  switch (op) {
    case Op::add:
      return a + b;
    case Op::subtract:
      return a - b;
    case Op::multiply:
      return a * b;
    case Op::divide:
      return a / b;
    case Op::power:
      return std::pow(a, b);
    case Op::arctangent2:
      return std::atan2(a, b);
    case Op::minimum:
      return smaller(a, b);
    case Op::maximum:
      return -smaller(-a, -b);
    case Op::less:
      return truth(a < b, a, b);
    case Op::less_equal:
      return truth(a <= b, a, b);
    case Op::equal:
      return truth(a == b, a, b);
    case Op::not_equal:
      return truth(a != b, a, b);
    case Op::logical_and:
      return truth(a != 0 && b != 0, a, b);
    default:
      return truth(a != 0 || b != 0, a, b);  // logical_or
  }
}

}  // namespace

double evaluate(Op op, double a, double b, double c) {
  switch (op) {
    case Op::multiply_add:
      return std::fma(a, b, c);
    case Op::negative_multiply_add:
      return std::fma(-a, b, c);
    case Op::where:
      return std::isnan(a) ? a : a != 0 ? b : c;
    default:
      return arguments_of(op) == 1 ? of_one(op, a) : of_two(op, a, b);
  }
}

}  // namespace rehearse::expression
