#include "rehearse/expression/tape_builder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/expression/scalar.hpp"

namespace rehearse::expression {
namespace {

constexpr double kLargestChain = 16;  // a power by so many multiplications is still cheaper than pow
constexpr int kDeepest = 10000;       // operations one inside another, through which functions here call themselves

bool commutes(Op op) {
  return op == Op::add || op == Op::multiply || op == Op::equal || op == Op::not_equal || op == Op::logical_and ||
         op == Op::logical_or;
}

}  // namespace

Node TapeBuilder::add(const Value& value) {
  values_.push_back(value);
  return static_cast<Node>(values_.size()) - 1;
}

Node TapeBuilder::constant(double value) {
  const auto [place, is_new] = constants_.try_emplace(std::bit_cast<std::uint64_t>(value), kNone);
  if (is_new) place->second = add({.kind = Value::Kind::constant, .pace = Pace::call, .number = value});
  return place->second;
}

Node TapeBuilder::input(Pace pace) { return add({.kind = Value::Kind::input, .pace = pace}); }

void TapeBuilder::known_trigonometry(Node angle, Node sine, Node cosine) { trigonometry_[angle] = {sine, cosine}; }

const double* TapeBuilder::constant_of(Node node) const {
  return at(node).kind == Value::Kind::constant ? &at(node).number : nullptr;
}

bool TapeBuilder::is_condition(Node node) const {
  const Value& value = at(node);
  if (value.kind != Value::Kind::operation) return is(node, 0) || is(node, 1);
  switch (value.op) {
    case Op::logical_not:
    case Op::less:
    case Op::less_equal:
    case Op::equal:
    case Op::not_equal:
    case Op::logical_and:
    case Op::logical_or:
      return true;
    case Op::where:
      return is_condition(value.b) && is_condition(value.c);
    case Op::multiply:
    case Op::minimum:
    case Op::maximum:
      return is_condition(value.a) && is_condition(value.b);
    default:
      return false;
  }
}

Node TapeBuilder::argument_of(Op op, Node node) const {
  return at(node).kind == Value::Kind::operation && at(node).op == op ? at(node).a : kNone;
}

bool TapeBuilder::is(Node node, double value) const {
  const double* constant = constant_of(node);
  return constant && *constant == value;
}

Node TapeBuilder::operation(Op op, Node a, Node b, Node c) {
  const auto number = [&](Node node) { return node == kNone ? 0 : at(node).number; };
  const auto known = [&](Node node) { return node == kNone || constant_of(node); };
  if (known(a) && known(b) && known(c)) return constant(evaluate(op, number(a), number(b), number(c)));
  if (const Node simpler = simplified(op, a, b); simpler != kNone) return simpler;
  if (commutes(op) && a > b) std::swap(a, b);
  if (const auto there = operations_.find({op, a, b, c}); there != operations_.end()) return there->second;
  Value value{.kind = Value::Kind::operation, .pace = Pace::call, .op = op, .a = a, .b = b, .c = c};
  for (const Node node : {a, b, c})
    if (node != kNone)
      value.pace = std::max(value.pace, at(node).pace), value.depth = std::max(value.depth, at(node).depth + 1);
  if (value.depth > kDeepest)
    throw InvalidInput(fmt::format("formulas have more than {} operations one inside another", kDeepest));
  return operations_[{op, a, b, c}] = add(value);
}

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
    default:
      return kNone;
  }
}

/// Divisions take a processor ten times as long as products, and equations divide by the same number again and again.
Node TapeBuilder::quotient(Node a, Node b) {
  if (is(a, 1) || constant_of(b)) return kNone;
  return operation(Op::multiply, a, operation(Op::divide, constant(1), b));
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

namespace {

/// Slots for values that are needed for a while.
class SlotPool {
 public:
  explicit SlotPool(std::int32_t first) : next_(first) {}
  std::int32_t take() {
    if (free_.empty()) return next_++;
    const std::int32_t slot = free_.back();
    free_.pop_back();
    return slot;
  }
  void give_back(std::int32_t slot) { free_.push_back(slot); }
  std::int32_t slots() const { return next_; }

 private:
  std::int32_t next_;
  std::vector<std::int32_t> free_;
};

}  // namespace

/// Values that outputs need, in order, with sums of products as one operation.
class TapeBuilder::Writer {
 public:
  Writer(std::vector<Value> values, const std::vector<Node>& outputs)
      : values_(std::move(values)), outputs_(outputs), uses_(values_.size(), 0), slots_(values_.size(), 0) {
    for (const Node output : outputs_) count(output);
    fuse();
  }

  Tape write() {
    Tape tape;
    place_constants_and_inputs(tape);
    std::vector<Node> order[3];
    std::vector<bool> placed(values_.size(), false);
    for (const Node output : outputs_) place(output, placed, order);
    SlotPool pool(tape.slots_of_inputs());
    for (const std::vector<Node>& nodes : order)
      for (std::size_t i = 0; i < nodes.size(); ++i)
        write(nodes[i], i > 0 ? nodes[i - 1] : kNone, i + 1 < nodes.size() ? nodes[i + 1] : kNone, pool, tape);
    for (const Node output : outputs_) tape.outputs.push_back(slot(output));
    tape.slots = pool.slots();
    return tape;
  }

 private:
  Value& at(Node node) { return values_[static_cast<std::size_t>(node)]; }
  int& uses(Node node) { return uses_[static_cast<std::size_t>(node)]; }
  std::int32_t& slot(Node node) { return slots_[static_cast<std::size_t>(node)]; }
  bool is_operation(std::size_t i) const { return values_[i].kind == Value::Kind::operation; }

  void count(Node node) {
    if (uses(node)++ > 0) return;
    for (const Node argument : {at(node).a, at(node).b, at(node).c})
      if (argument != kNone) count(argument);
  }

  /// A product that nothing else uses, of the same pace: a product that is computed less often stays so.
  bool is_product_of_its_own(Node node, Pace pace) {
    return at(node).op == Op::multiply && is_operation(static_cast<std::size_t>(node)) && uses(node) == 1 &&
           at(node).pace == pace;
  }

  void fuse() {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (!is_operation(i) || uses_[i] == 0) continue;
      Value& value = values_[i];
      if (value.op != Op::add && value.op != Op::subtract) continue;
      const bool sum = value.op == Op::add;
      const Node product = is_product_of_its_own(value.b, value.pace)          ? value.b
                           : sum && is_product_of_its_own(value.a, value.pace) ? value.a
                                                                               : kNone;
      if (product == kNone) continue;
      const Node other = product == value.b ? value.a : value.b;
      value.op = sum ? Op::multiply_add : Op::negative_multiply_add;
      value.a = at(product).a, value.b = at(product).b, value.c = other;
      uses(product) = 0;
    }
  }

  void place_constants_and_inputs(Tape& tape) {
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (values_[i].kind == Value::Kind::constant && uses_[i] > 0) {
        slots_[i] = static_cast<std::int32_t>(tape.constants.size());
        tape.constants.push_back(values_[i].number);
      }
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (values_[i].kind == Value::Kind::input) slots_[i] = tape.input_slot(tape.inputs++);
  }

  /// Places a value after its arguments, by pace; last of these one that nothing else needs, since it may stay in
  /// registers.
  void place(Node node, std::vector<bool>& placed, std::vector<Node> (&order)[3]) {
    if (node == kNone || !is_operation(static_cast<std::size_t>(node)) || placed[static_cast<std::size_t>(node)])
      return;
    placed[static_cast<std::size_t>(node)] = true;
    const Value& value = at(node);
    Node last = kNone;
    for (const Node of : {value.a, value.b, value.c})
      if (of != kNone && at(of).pace == value.pace && uses(of) == 1) last = of;
    for (const Node of : {value.a, value.b, value.c})
      if (of != last) place(of, placed, order);
    place(last, placed, order);
    order[static_cast<std::size_t>(value.pace)].push_back(node);
  }

  /// The argument of `next` that is the value `node`, and may stay in registers till then. A second such argument needs
  /// it in memory.
  Argument handed_over(Node node, Node next) {
    if (node == kNone || next == kNone || !stays_in_registers(at(node).op) || !stays_in_registers(at(next).op))
      return Argument::none;
    const Value& value = at(next);
    if ((value.a == node) + (value.b == node) + (value.c == node) != 1) return Argument::none;
    return value.a == node ? Argument::a : value.b == node ? Argument::b : Argument::c;
  }

  /// Appends an instruction. Values of pace `always` give their slots to others when nobody needs them; the rest stays.
  void write(Node node, Node before, Node next, SlotPool& pool, Tape& tape) {
    const Value& value = at(node);
    const auto argument = [&](Node of) { return of == kNone ? 0 : slot(of); };
    Instruction instruction{.op = value.op,
                            .in_registers = handed_over(before, node),
                            .is_stored = uses(node) > 1 || handed_over(node, next) == Argument::none,
                            .a = argument(value.a),
                            .b = argument(value.b),
                            .c = argument(value.c)};
    if (value.pace == Pace::always)
      for (const Node of : {value.a, value.b, value.c}) release(of, pool);
    if (instruction.is_stored) instruction.out = pool.take();
    slot(node) = instruction.out;
    tape.code[static_cast<std::size_t>(value.pace)].push_back(instruction);
  }

  void release(Node node, SlotPool& pool) {
    if (node == kNone || at(node).kind != Value::Kind::operation || at(node).pace != Pace::always) return;
    if (--uses(node) == 0 && slot(node) != 0) pool.give_back(slot(node));  // 0: never stored
  }

  std::vector<Value> values_;
  const std::vector<Node>& outputs_;
  std::vector<int> uses_;  // by values and outputs that are needed themselves
  std::vector<std::int32_t> slots_;
};

Tape TapeBuilder::tape(const std::vector<Node>& outputs) const { return Writer(values_, outputs).write(); }

}  // namespace rehearse::expression
