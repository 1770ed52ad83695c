#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "rehearse/expression/tape.hpp"

namespace rehearse::expression {

/// A value of a formula.
using Node = std::int32_t;

/// Makes a tape of values that depend on each other. The same operation on the same values is one value; what depends
/// on constants alone is a constant; products are fused with the sums that they are part of.
class TapeBuilder {
 public:
  Node constant(double value);
  Node input(Pace pace);  // each call another one
  /// Throws InvalidInput if operations are nested too deeply to be followed.
  Node operation(Op op, Node a, Node b = kNone, Node c = kNone);

  /// Sine and cosine of an input that are inputs themselves: sin(a) and cos(a) are these from then on, and those of
  /// sums and differences of such inputs follow.
  void known_trigonometry(Node angle, Node sine, Node cosine);

  /// The constant that a node is; null where it is none.
  const double* constant_of(Node node) const;

  /// True if a node is 0 or 1 by what makes it: a comparison, conditions that are combined, or one of these numbers.
  bool is_condition(Node node) const;

  /// The argument of the operation that makes the node, where that is `op`, an operation of one number; else kNone.
  Node argument_of(Op op, Node node) const;

  Tape tape(const std::vector<Node>& outputs) const;

  static constexpr Node kNone = -1;

 private:
  class Writer;
  struct Value {
    enum class Kind : std::uint8_t { constant, input, operation } kind;
    Pace pace;
    double number = 0;  // of a constant
    Op op{};
    Node a = kNone, b = kNone, c = kNone;
    int depth = 0;  // of operations one inside another
  };
  struct Trigonometry {
    Node sine, cosine;
  };
  using Key = std::tuple<Op, Node, Node, Node>;

  const Value& at(Node node) const { return values_[static_cast<std::size_t>(node)]; }
  Node add(const Value& value);
  bool is(Node node, double value) const;
  Node as_it_is(Op op, Node a, Node b, Node c);
  Node simplified(Op op, Node a, Node b);    // kNone: it is as simple as it can be
  Node quotient(Node a, Node b);             // likewise
  Node of_divisions(Op op, Node a, Node b);  // likewise
  Node power(Node base, Node exponent);      // likewise
  Node trigonometric(Op op, Node a);         // likewise
  std::optional<Trigonometry> trigonometry_of(Node node);

  std::vector<Value> values_;
  std::map<std::uint64_t, Node> constants_;  // by their bits
  std::map<Key, Node> operations_;
  std::map<Node, Trigonometry> trigonometry_;
  std::map<Node, std::pair<Node, Node>> quotients_;  // a and b of products a (1/b)
};

}  // namespace rehearse::expression
