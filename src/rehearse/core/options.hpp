#pragma once
// Options are plain structs that name their own fields, once, for everything that needs names: --set, spec.toml,
// validation, `rehearse list` and docs/options.md.
//
//   struct SubplexOptions {
//     Index max_evaluations = 1000;
//     double first_step_m = 0.1;
//     void fields(FieldVisitor& v) {
//       v.integer("max_evaluations", max_evaluations, "evaluations at most", at_least(1), published(500, kAuthors));
//       v.number("first_step_m", first_step_m, expert("length of the first step [m]"), above(0));
//     }
//   };

#include <concepts>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// The values a number may take.
struct Bound {
  double low = -kInf;
  double high = kInf;
  bool low_open = false;  // low itself is not allowed
  bool infinite = false;  // infinity is
};
inline Bound any_value() { return {.infinite = true}; }
inline Bound at_least(double low) { return {.low = low}; }
inline Bound above(double low) { return {.low = low, .low_open = true}; }
inline Bound between(double low, double high) { return {.low = low, .high = high}; }

inline constexpr const char* kPaper = "the paper";            // Chatzilygeroudis 2018
inline constexpr const char* kAuthors = "the authors' code";  // where the paper does not say

/// The value that a publication has for an option; where it has no such thing, the one that turns the option off.
struct Published {
  std::string text;  // as `set_field` reads it; empty: the default is as published
  std::string source;
};

/// The shortest text that reads back as the same double.
std::string to_text(double value);

template <std::same_as<bool> Flag>
Published published(Flag value, std::string source = kPaper) {
  return {value ? "true" : "false", std::move(source)};
}
inline Published published(double value, std::string source = kPaper) { return {to_text(value), std::move(source)}; }
inline Published published(int value, std::string source = kPaper) {
  return {std::to_string(value), std::move(source)};
}
inline Published published(const char* name, std::string source = kPaper) { return {name, std::move(source)}; }

/// The users who are shown an option without asking for more: experts have tolerances of solvers and the like.
enum class Audience { everyone, experts };
inline constexpr Audience kExpert = Audience::experts;

/// A line that says what an option does. A unit stands in brackets at its end: "length of the pole [m]".
struct Help {
  constexpr Help(const char* line, Audience whom = Audience::everyone)  // NOLINT(google-explicit-constructor)
      : text(line), audience(whom) {}

  std::string_view text;
  Audience audience;
};
constexpr Help expert(const char* line) { return {line, kExpert}; }

/// A visitor is shown the fields of an options struct, one after the other. Names are joined with dots by `group`.
class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;

  void number(std::string_view name, double& value, Help help, Bound bound = {}, Published published = {}) {
    visit(enter(name, help, std::move(published)), value, bound);
  }
  void integer(std::string_view name, Index& value, Help help, Bound bound = {}, Published published = {}) {
    visit(enter(name, help, std::move(published)), value, bound);
  }
  void boolean(std::string_view name, bool& value, Help help, Published published = {}) {
    visit(enter(name, help, std::move(published)), value);
  }
  void text(std::string_view name, std::string& value, Help help) { visit(enter(name, help, {}), value); }

  /// An enumeration whose values 0, 1, … are called `names`.
  template <class Enum>
  void choice(std::string_view name, Enum& value, Help help, const std::vector<std::string>& names,
              Published published = {}) {
    int index = static_cast<int>(value);
    visit(enter(name, help, std::move(published)), index, names);
    value = static_cast<Enum>(index);
  }

  /// A condition between fields. violation begins with the name of one: "first_step = 9, must be ≤ largest_step = 5".
  void require(bool holds, const std::string& violation) {
    if (!holds) refuse(full(violation));
  }

  /// Says what is published of a field that comes later, whatever is said there: for structs that several others have.
  void publish(std::string_view name, Published published) { known_.emplace(full(name), std::move(published)); }

  /// The fields of a nested options struct, as "name.field"; all of them are for experts where the group is.
  template <class Options>
  void group(std::string_view name, Options& options, Audience audience = Audience::everyone) {
    const std::string outer = prefix_;
    const Audience outer_audience = audience_;
    prefix_ += std::string(name) + ".";
    if (audience == kExpert) audience_ = kExpert;
    options.fields(*this);
    prefix_ = outer;
    audience_ = outer_audience;
  }

 protected:
  virtual void visit(const std::string& name, double& value, Bound bound) = 0;
  virtual void visit(const std::string& name, Index& value, Bound bound) = 0;
  virtual void visit(const std::string& name, bool& value) = 0;
  virtual void visit(const std::string& name, std::string& value) = 0;
  virtual void visit(const std::string& name, int& value, const std::vector<std::string>& names) = 0;

  virtual void refuse(const std::string& /*violation*/) {}

  // The published value and the help of the field that is visited.
  const Published& published() const { return published_; }
  const Help& help() const { return help_; }  // its audience is that of its groups, too

 private:
  std::string full(std::string_view name) const { return prefix_ + std::string(name); }
  std::string enter(std::string_view name, Help help, Published published);

  std::string prefix_;
  Audience audience_ = Audience::everyone;
  std::map<std::string, Published> known_;
  Published published_;
  Help help_{""};
};

/// Anything with fields: `[&](FieldVisitor& v) { v.group("search", search); }`.
using Fields = std::function<void(FieldVisitor&)>;

/// An option as it describes itself.
struct Field {
  std::string name;
  std::string value;  // as `set_field` reads it back exactly
  std::string help;
  std::string bound;                 // "≥ 0", "0 to 1"; empty: any
  std::vector<std::string> choices;  // empty: no choice
  bool expert = false;
  Published published;

  bool deviates() const { return !published.text.empty() && published.text != value; }
};

/// Every field, in order of declaration.
std::vector<Field> describe_fields(const Fields& fields);

/// Their names and values alone.
std::vector<std::pair<std::string, std::string>> list_fields(const Fields& fields);

/// Sets one field from text. Returns false if there is no field of that name.
/// Throws InvalidInput if the text is no such value or violates the bound ("cmaes.population = 0, must be ≥ 4").
bool set_field(const Fields& fields, std::string_view name, std::string_view text);

/// A line for every field that violates its bound, and for every condition between fields that does not hold.
std::vector<std::string> field_violations(const Fields& fields);

/// The same of the fields of one struct, as "group.field".
template <class Options>
std::vector<std::string> field_violations(std::string_view group, Options options) {
  return field_violations([&](FieldVisitor& v) { v.group(group, options); });
}

/// The name most like `name`, for "did you mean".
std::string closest(std::string_view name, const std::vector<std::string>& names);

/// ", did you mean 'X'?" of the closest; empty where none is much like `name`.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& names);

/// The same, then all names: ", did you mean 'X'? (known: X, Y)".
std::string suggestions(std::string_view name, const std::vector<std::string>& names);

/// Reads a whole text as a double. Returns false if it is not one.
bool from_text(std::string_view text, double& value);

}  // namespace rehearse
