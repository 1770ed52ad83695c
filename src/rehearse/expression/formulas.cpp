#include "rehearse/expression/formulas.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstring>
#include <deque>
#include <functional>
#include <numbers>
#include <regex>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/core/options.hpp"

namespace rehearse::expression {
namespace {

// muParser computes with doubles. It is made to compute with nodes instead: variables hold NaNs that carry the number
// of a node, its own operators are replaced by functions that make an operation of two nodes, and so the result of a
// formula is the node of its value. All other doubles are numbers of the formula.
constexpr std::uint64_t kBoxed = 0x7FF9'5245'0000'0000, kPayload = 0xFFFF'FFFF;
constexpr std::uint64_t kCompared = 0x7FF9'5246'0000'0000;  // the value of a < b as it stands in a formula

double boxed(Node node, std::uint64_t kind = kBoxed) {
  return std::bit_cast<double>(kind | static_cast<std::uint32_t>(node));
}

bool carries(std::uint64_t kind, double value) { return (std::bit_cast<std::uint64_t>(value) & ~kPayload) == kind; }

thread_local TapeBuilder* current = nullptr;  // of the formula that is compiled

Node unboxed(double value) {
  if (carries(kBoxed, value) || carries(kCompared, value))
    return static_cast<Node>(std::bit_cast<std::uint64_t>(value) & kPayload);
  return current->constant(value);
}

template <Op op>
double one(double a) {
  return boxed(current->operation(op, unboxed(a)));
}
template <Op op>
double two(double a, double b) {
  return boxed(current->operation(op, unboxed(a), unboxed(b)));
}
/// muParser reads a < b < c as (a < b) < c, which compares 0 or 1.
template <Op op>
double compared(double a, double b) {
  if (carries(kCompared, a) || carries(kCompared, b)) throw InvalidInput("'a < b < c' is written a < b && b < c");
  return boxed(current->operation(op, unboxed(a), unboxed(b)), kCompared);
}
/// a > b is b < a.
template <Op op>
double swapped(double a, double b) {
  return compared<op>(b, a);
}
double where(double condition, double a, double b) {
  return boxed(current->operation(Op::where, unboxed(condition), unboxed(a), unboxed(b)));
}
double clamp(double x, double low, double high) { return two<Op::minimum>(two<Op::maximum>(x, low), high); }
double same(double a) { return a; }

struct Unary {
  const char* name;
  double (*function)(double);
};
struct Binary {
  const char* name;
  double (*function)(double, double);
};
struct Ternary {
  const char* name;
  double (*function)(double, double, double);
};

constexpr Unary kUnary[] = {{"sin", one<Op::sine>},
                            {"cos", one<Op::cosine>},
                            {"tan", one<Op::tangent>},
                            {"asin", one<Op::arcsine>},
                            {"acos", one<Op::arccosine>},
                            {"atan", one<Op::arctangent>},
                            {"sinh", one<Op::hyperbolic_sine>},
                            {"cosh", one<Op::hyperbolic_cosine>},
                            {"tanh", one<Op::hyperbolic_tangent>},
                            {"exp", one<Op::exponential>},
                            {"log", one<Op::logarithm>},
                            {"sqrt", one<Op::square_root>},
                            {"abs", one<Op::absolute>},
                            {"sign", one<Op::sign>},
                            {"floor", one<Op::round_down>},
                            {"ceil", one<Op::round_up>},
                            {"not", one<Op::logical_not>}};
constexpr Binary kBinary[] = {
    {"atan2", two<Op::arctangent2>}, {"min", two<Op::minimum>}, {"max", two<Op::maximum>}, {"pow", two<Op::power>}};
constexpr Ternary kTernary[] = {{"where", where}, {"clamp", clamp}};

struct Operator {
  const char* name;
  double (*function)(double, double);
  unsigned precedence;
  mu::EOprtAssociativity associativity = mu::oaLEFT;
};
const Operator kOperators[] = {{"+", two<Op::add>, mu::prADD_SUB},
                               {"-", two<Op::subtract>, mu::prADD_SUB},
                               {"*", two<Op::multiply>, mu::prMUL_DIV},
                               {"/", two<Op::divide>, mu::prMUL_DIV},
                               {"^", two<Op::power>, mu::prPOW, mu::oaRIGHT},
                               {"<", compared<Op::less>, mu::prCMP},
                               {"<=", compared<Op::less_equal>, mu::prCMP},
                               {">", swapped<Op::less>, mu::prCMP},
                               {">=", swapped<Op::less_equal>, mu::prCMP},
                               {"==", two<Op::equal>, mu::prCMP},
                               {"!=", two<Op::not_equal>, mu::prCMP},
                               {"&&", two<Op::logical_and>, mu::prLAND},
                               {"||", two<Op::logical_or>, mu::prLOR}};

/// Takes a number from the front of the text, whatever the locale.
int take_number(const char* text, int* position, double* value) {
  if (!std::isdigit(static_cast<unsigned char>(*text)) && *text != '.') return 0;
  const auto [end, error] = std::from_chars(text, text + std::strlen(text), *value);
  if (error != std::errc()) return 0;
  *position += static_cast<int>(end - text);
  return 1;
}

class Grammar : public mu::ParserBase {
 public:
  Grammar() {
    EnableBuiltInOprt(false);
    AddValIdent(take_number);
    DefineNameChars("0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
    DefineOprtChars("+-*/^<>=!&|");
    DefineInfixOprtChars("+-!");
    for (const auto& [name, function] : kUnary) DefineFun(name, function, false);
    for (const auto& [name, function] : kBinary) DefineFun(name, function, false);
    for (const auto& [name, function] : kTernary) DefineFun(name, function, false);
    for (const auto& [name, function, precedence, associativity] : kOperators)
      DefineOprt(name, function, precedence, associativity, false);
    DefineInfixOprt("-", one<Op::negate>, mu::prINFIX, false);
    DefineInfixOprt("+", same, mu::prINFIX, false);
    DefineInfixOprt("!", one<Op::logical_not>, mu::prINFIX, false);
  }

 private:
  void InitCharSets() override {}
  void InitFun() override {}
  void InitConst() override {}
  void InitOprt() override {}
};

constexpr std::size_t kMostDefinitions = 500;  // each needed by the one before

/// Finds the node of a name while a formula is compiled.
struct Lookup {
  std::function<Node(const std::string&)> node;
  std::deque<double> values;  // whose addresses muParser keeps
};

double* look_up(const char* name, void* lookup) {
  auto& [node, values] = *static_cast<Lookup*>(lookup);
  return &values.emplace_back(boxed(node(name)));
}

/// Throws InvalidInput for operators as other languages spell them: muParser lacks them, or reads something else.
void refuse_other_spellings(const std::string& formula) {
  static const std::pair<std::regex, const char*> kSpellings[] = {
      {std::regex(R"(\?)"), "'a ? b : c' is written where(a, b, c)"},
      {std::regex(R"(\band\b)"), "'a and b' is written a && b"},
      {std::regex(R"(\bor\b)"), "'a or b' is written a || b"},
      {std::regex(R"(\*\*)"), "'a ** b' is written a ^ b"},
      {std::regex(R"((^|[^=<>!])=([^=]|$))"), "'a = b' is written a == b"}};
  for (const auto& [spelling, message] : kSpellings)
    if (std::regex_search(formula, spelling)) throw InvalidInput(message);
}

/// Functions as other languages have them, whose nearest name would mislead.
const std::map<std::string, const char*, std::less<>> kOtherNames = {
    {"ln", "'ln(a)' is written log(a)"},
    {"log10", "'log10(a)' is written log(a) / log(10)"},
    {"mod", "'mod(a, b)' is written a - b * floor(a / b)"},
    {"round", "'round(a)' is written floor(a + 0.5)"}};

}  // namespace

const std::vector<std::string>& Formulas::function_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& f : kUnary) all.emplace_back(f.name);
    for (const auto& f : kBinary) all.emplace_back(f.name);
    for (const auto& f : kTernary) all.emplace_back(f.name);
    return all;
  }();
  return names;
}

void Formulas::check_name(const std::string& name) const {
  const auto is_part = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  const bool good = !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
                    std::all_of(name.begin(), name.end(), is_part);
  if (!good) throw InvalidInput(fmt::format("'{}' is no name: letters, digits and _, and no digit first", name));
  if (is_among(name, function_names()) || name == "pi")
    throw InvalidInput(fmt::format("'{}' is {}", name, name == "pi" ? "the number π" : "a function"));
  if (inputs_.contains(name) || definitions_.contains(name))
    throw InvalidInput(fmt::format("the name '{}' is given twice", name));
}

Node Formulas::input(const std::string& name, Pace pace) {
  check_name(name);
  return inputs_[name] = builder_.input(pace);
}

void Formulas::define(const std::string& name, const std::string& formula) {
  check_name(name);
  definitions_[name] = {.formula = formula};
}

Node Formulas::named(const std::string& name) {
  if (name == "pi") return builder_.constant(std::numbers::pi);
  if (const auto found = inputs_.find(name); found != inputs_.end()) return found->second;
  const auto found = definitions_.find(name);
  if (found == definitions_.end()) throw_unknown(name);
  return compiled(found->second, name);
}

Node Formulas::compiled(Definition& definition, const std::string& name) {
  if (definition.node != TapeBuilder::kNone) return definition.node;
  const auto first = std::find(under_way_.begin(), under_way_.end(), name);
  if (first != under_way_.end())
    throw InvalidInput(fmt::format("the definition of '{0}' needs itself: {1} → {0}", name,
                                   fmt::join(first, under_way_.end(), " → ")));
  if (under_way_.size() == kMostDefinitions)  // or the stack would overflow
    throw InvalidInput(fmt::format("'{}' needs more than {} definitions", under_way_.front(), kMostDefinitions));
  under_way_.push_back(name);
  try {
    definition.node = compile(definition.formula);
  } catch (...) {  // another formula may need it, too
    under_way_.pop_back();
    throw;
  }
  under_way_.pop_back();
  return definition.node;
}

void Formulas::elsewhere(const std::string& name, const std::string& why) { elsewhere_[name] = why; }

void Formulas::throw_unknown(const std::string& name) const {
  if (is_among(name, function_names())) throw InvalidInput(fmt::format("'{0}' is a function: {0}(…)", name));
  if (const auto found = elsewhere_.find(name); found != elsewhere_.end())
    throw InvalidInput(
        fmt::format("'{}'{} {}", name,
                    under_way_.empty() ? "" : fmt::format(", which the definition of '{}' uses,", under_way_.back()),
                    found->second));
  if (const auto found = kOtherNames.find(name); found != kOtherNames.end())
    throw InvalidInput(fmt::format("unknown name '{}': {}", name, found->second));
  std::vector<std::string> known;
  for (const auto& [input, node] : inputs_) known.push_back(input);
  for (const auto& [definition, formula] : definitions_) known.push_back(definition);
  std::vector<std::string> like = known;
  like.insert(like.end(), function_names().begin(), function_names().end());
  throw InvalidInput(
      fmt::format("unknown name '{}'{} (known: {})", name, did_you_mean(name, like), fmt::join(known, ", ")));
}

Node Formulas::compile(const std::string& formula) {
  refuse_other_spellings(formula);
  TapeBuilder* outer = std::exchange(current, &builder_);
  Lookup lookup{[this](const std::string& name) { return named(name); }, {}};
  try {
    Grammar grammar;
    grammar.SetVarFactory(look_up, &lookup);
    grammar.SetExpr(formula);
    const Node node = unboxed(grammar.Eval());
    if (grammar.GetNumResults() != 1)
      throw InvalidInput(
          fmt::format("'{}': a comma outside of a function's brackets; decimals are written 1.5", formula));
    current = outer;
    return node;
  } catch (const mu::Parser::exception_type& error) {
    current = outer;
    throw InvalidInput(fmt::format("'{}': {}", formula, error.GetMsg()));
  } catch (...) {
    current = outer;
    throw;
  }
}

Node Formulas::compile_condition(const std::string& formula) {
  const Node node = compile(formula);
  if (builder_.is_condition(node)) return node;
  throw InvalidInput(fmt::format("'{0}' is a number and no condition: compare it, as in {0} < 0.5", formula));
}

}  // namespace rehearse::expression
