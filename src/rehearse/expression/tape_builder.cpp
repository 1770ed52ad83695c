#include "rehearse/expression/tape_builder.hpp"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/expression/scalar.hpp"

namespace rehearse::expression {
namespace {

constexpr int kDeepest = 10000;  // operations one inside another, through which functions here call themselves

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
  const Node simpler = simplified(op, a, b);
  return simpler != kNone ? simpler : as_it_is(op, a, b, c);
}

Node TapeBuilder::as_it_is(Op op, Node a, Node b, Node c) {
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
