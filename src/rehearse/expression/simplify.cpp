// TapeBuilder: faster operations in the place of others.

#include <cmath>
#include <cstdlib>

#include "rehearse/expression/tape_builder.hpp"

namespace rehearse::expression {
namespace {

constexpr double kLargestChain = 16;  // a power by so many multiplications is still cheaper than pow

}  // namespace

Node TapeBuilder::simplified(Op op, Node a, Node b) {
  switch (op) {
    case Op::add:
      return is(a, 0) ? b : is(b, 0) ? a : kNone;
    case Op::subtract:
      return is(b, 0) ? a : kNone;
    case Op::multiply:
      return is(a, 1) ? b : is(b, 1) ? a : kNone;
    case Op::divide:
      return is(b, 1) ? a : quotient(a, b);
    case Op::power:
      return power(a, b);
    case Op::sine:
    case Op::cosine:
      return trigonometric(op, a);
    case Op::round_down:
    case Op::round_up:
    case Op::less:
    case Op::less_equal:
    case Op::equal:
    case Op::not_equal:
      return of_divisions(op, a, b);
    default:
      return kNone;
  }
}

/// Divisions take a processor ten times as long as products, and equations divide by the same number again and again.
Node TapeBuilder::quotient(Node a, Node b) {
  if (is(a, 1) || constant_of(b)) return kNone;
  const Node product = operation(Op::multiply, a, operation(Op::divide, constant(1), b));
  quotients_.try_emplace(product, a, b);
  return product;
}

/// Rounding and comparisons are given true divisions: a product with 1/b is rounded twice, so that 49/49 is below 1.
Node TapeBuilder::of_divisions(Op op, Node a, Node b) {
  const auto divided = [this](Node node) {
    const auto found = quotients_.find(node);
    return found == quotients_.end() ? node : as_it_is(Op::divide, found->second.first, found->second.second, kNone);
  };
  const Node of_a = divided(a), of_b = divided(b);
  return of_a == a && of_b == b ? kNone : operation(op, of_a, of_b);
}

Node TapeBuilder::power(Node base, Node exponent) {
  const double* constant_exponent = constant_of(exponent);
  if (!constant_exponent) return kNone;
  const double n = *constant_exponent;
  if (n == 0) return constant(1);
  if (n == 0.5) return operation(Op::square_root, base);
  if (n != std::floor(n) || std::abs(n) > kLargestChain) return kNone;
  Node product = base;
  for (int i = 1; i < std::abs(static_cast<int>(n)); ++i) product = operation(Op::multiply, product, base);
  return n > 0 ? product : operation(Op::divide, constant(1), product);
}

std::optional<TapeBuilder::Trigonometry> TapeBuilder::trigonometry_of(Node node) {
  if (const auto known = trigonometry_.find(node); known != trigonometry_.end()) return known->second;
  const Value value = at(node);
  if (value.kind != Value::Kind::operation || (value.op != Op::add && value.op != Op::subtract)) return {};
  const auto a = trigonometry_of(value.a), b = trigonometry_of(value.b);
  if (!a || !b) return {};
  const auto times = [&](Node x, Node y) { return operation(Op::multiply, x, y); };
  const bool sum = value.op == Op::add;
  const Trigonometry both{
      operation(sum ? Op::add : Op::subtract, times(a->sine, b->cosine), times(a->cosine, b->sine)),
      operation(sum ? Op::subtract : Op::add, times(a->cosine, b->cosine), times(a->sine, b->sine))};
  trigonometry_[node] = both;
  return both;
}

Node TapeBuilder::trigonometric(Op op, Node a) {
  const auto known = trigonometry_of(a);
  if (!known) return kNone;
  return op == Op::sine ? known->sine : known->cosine;
}

}  // namespace rehearse::expression
