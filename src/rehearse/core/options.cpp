#include "rehearse/core/options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"

namespace rehearse {
namespace {

std::string bound_text(const Bound& bound, const char* both) {
  const bool low = std::isfinite(bound.low), high = std::isfinite(bound.high);
  if (low && high && bound.low_open) return fmt::format("> {} and ≤ {}", to_text(bound.low), to_text(bound.high));
  if (low && high) return fmt::format(fmt::runtime(both), to_text(bound.low), to_text(bound.high));
  if (high) return fmt::format("≤ {}", to_text(bound.high));
  return low ? fmt::format("{} {}", bound.low_open ? ">" : "≥", to_text(bound.low)) : "";
}

std::string violation(const std::string& name, double value, const Bound& bound) {
  const bool low_ok = bound.low_open ? value > bound.low : value >= bound.low;
  const bool in = low_ok && value <= bound.high;  // NaN fails both
  if (in && (bound.infinite || std::isfinite(value))) return {};
  std::string line = fmt::format("{} = {}, must be ", name, to_text(value));
  if (in) return line + "finite";
  const std::string bounds = bound_text(bound, "between {} and {}");
  return line + (bounds.empty() ? "a number" : bounds);
}

/// The value as a double, which is not less than it even where the value has more digits than a double.
double as_double(Index value) {
  const auto nearest = static_cast<double>(value);
  constexpr double kTooLarge = 9223372036854775808.0;  // 2^63
  const bool less = nearest < kTooLarge && static_cast<Index>(nearest) < value;
  return less ? std::nextafter(nearest, kTooLarge) : nearest;
}

class Describer final : public FieldVisitor {
 public:
  std::vector<Field> fields;

 protected:
  void visit(const std::string& name, double& value, Bound bound) override {
    add(name, to_text(value)).bound = bound_text(bound, "{} to {}");
  }
  void visit(const std::string& name, Index& value, Bound bound) override {
    add(name, fmt::to_string(value)).bound = bound_text(bound, "{} to {}");
  }
  void visit(const std::string& name, bool& value) override {
    add(name, value ? "true" : "false").choices = {"true", "false"};
  }
  void visit(const std::string& name, std::string& value) override { add(name, value); }
  void visit(const std::string& name, int& value, const std::vector<std::string>& names) override {
    add(name, names.at(static_cast<std::size_t>(value))).choices = names;
  }

 private:
  Field& add(const std::string& name, std::string value) {
    return fields.emplace_back(Field{.name = name,
                                     .value = std::move(value),
                                     .help = std::string(help().text),
                                     .expert = help().audience == kExpert,
                                     .published = published()});
  }
};

class Checker final : public FieldVisitor {
 public:
  std::vector<std::string> violations;

 protected:
  void visit(const std::string& name, double& value, Bound bound) override { add(violation(name, value, bound)); }
  void visit(const std::string& name, Index& value, Bound bound) override {
    add(violation(name, as_double(value), bound));
  }
  void visit(const std::string&, bool&) override {}
  void visit(const std::string&, std::string&) override {}
  void visit(const std::string&, int&, const std::vector<std::string>&) override {}
  void refuse(const std::string& violation) override { add(violation); }

 private:
  void add(std::string line) {
    if (!line.empty()) violations.push_back(std::move(line));
  }
};

class Setter final : public FieldVisitor {
 public:
  Setter(std::string_view name, std::string_view text) : name_(name), text_(text) {}
  bool found = false;

 protected:
  void visit(const std::string& name, double& value, Bound bound) override {
    if (!match(name)) return;
    double parsed = 0;
    if (!from_text(text_, parsed)) wrong("a number");
    check(violation(name, parsed, bound));
    value = parsed;
  }
  void visit(const std::string& name, Index& value, Bound bound) override {
    if (!match(name)) return;
    Index parsed = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), parsed);
    double too_large = 0;
    if (error == std::errc::result_out_of_range && from_text(text_, too_large)) {
      check(violation(name, too_large, bound));
      wrong(fmt::format("within ±{}", std::numeric_limits<Index>::max()));
    }
    if (error != std::errc{} || end != text_.data() + text_.size()) wrong("a whole number");
    check(violation(name, as_double(parsed), bound));
    value = parsed;
  }
  void visit(const std::string& name, bool& value) override {
    if (!match(name)) return;
    if (text_ != "true" && text_ != "false") wrong("true or false");
    value = text_ == "true";
  }
  void visit(const std::string& name, std::string& value) override {
    if (match(name)) value = text_;
  }
  void visit(const std::string& name, int& value, const std::vector<std::string>& names) override {
    if (!match(name)) return;
    // A choice between on, off and more was a boolean before it had more, or is taken for one.
    const std::string_view text = text_ == "true" ? "on" : text_ == "false" ? "off" : text_;
    const auto found_name = std::find(names.begin(), names.end(), text);
    if (found_name == names.end()) wrong(fmt::format("one of {}", fmt::join(names, ", ")));
    value = static_cast<int>(found_name - names.begin());
  }

 private:
  bool match(const std::string& name) { return name == name_ && (found = true); }
  void check(const std::string& line) const {
    if (!line.empty()) throw InvalidInput(line);
  }
  [[noreturn]] void wrong(const std::string& expected) const {
    throw InvalidInput(fmt::format("{} = {}, must be {}", name_, text_, expected));
  }
  std::string_view name_, text_;
};

/// The number of letters that are missing, too many, or others, and of neighbours that changed places.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> mistakes(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      std::size_t& least = mistakes[i][j];
      least = i == 0 || j == 0 ? i + j : mistakes[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
      if (i > 0) least = std::min(least, mistakes[i - 1][j] + 1);
      if (j > 0) least = std::min(least, mistakes[i][j - 1] + 1);
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        least = std::min(least, mistakes[i - 2][j - 2] + 1);
    }
  return mistakes.back().back();
}

bool lacks_groups(std::string_view name, std::string_view whole) { return whole.ends_with(fmt::format(".{}", name)); }

/// The length of the dashes, or of the groups of options, that two names have in common: they say nothing of what was
/// meant.
std::size_t common_groups(std::string_view a, std::string_view b) {
  const auto [end, none] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  const std::string_view same = a.substr(0, static_cast<std::size_t>(end - a.begin()));
  const std::size_t dot = same.find_last_of('.');
  return dot != std::string_view::npos ? dot + 1 : same.starts_with("--") ? 2 : 0;
}

/// True if `other` may have been meant: at most a third of the letters of `name` are wrong, or one is short for the
/// other.
bool is_like(std::string_view name, std::string_view other) {
  const std::size_t common = common_groups(name, other);
  name.remove_prefix(common), other.remove_prefix(common);
  const std::size_t most = (name.size() + 2) / 3;
  return lacks_groups(name, other) || other.starts_with(name) || name.starts_with(other) ||
         edit_distance(in_lower_case(name), in_lower_case(other)) <= most;
}

}  // namespace

std::string FieldVisitor::enter(std::string_view name, Help help, Published published) {
  std::string whole = full(name);
  const auto known = known_.find(whole);
  published_ = known == known_.end() ? std::move(published) : known->second;
  help_ = help;
  if (audience_ == kExpert) help_.audience = kExpert;
  return whole;
}

std::vector<Field> describe_fields(const Fields& fields) {
  Describer describer;
  fields(describer);
  return std::move(describer.fields);
}

std::vector<std::pair<std::string, std::string>> list_fields(const Fields& fields) {
  std::vector<std::pair<std::string, std::string>> list;
  for (Field& field : describe_fields(fields)) list.emplace_back(std::move(field.name), std::move(field.value));
  return list;
}

bool set_field(const Fields& fields, std::string_view name, std::string_view text) {
  Setter setter(name, text);
  fields(setter);
  return setter.found;
}

std::vector<std::string> field_violations(const Fields& fields) {
  Checker checker;
  fields(checker);
  return std::move(checker.violations);
}

std::string closest(std::string_view name, const std::vector<std::string>& names) {
  // Groups that are left out are a smaller mistake than a letter, and a capital letter than another one.
  const auto distance = [&](std::string_view other) {
    return std::tuple(!lacks_groups(name, other), edit_distance(in_lower_case(name), in_lower_case(other)),
                      edit_distance(name, other));
  };
  const auto best = std::min_element(names.begin(), names.end(),
                                     [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  return best == names.end() ? std::string{} : *best;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& names) {
  const std::string near = closest(name, names);
  return !near.empty() && is_like(name, near) ? fmt::format(", did you mean '{}'?", near) : "";
}

std::string suggestions(std::string_view name, const std::vector<std::string>& names) {
  return fmt::format("{} (known: {})", did_you_mean(name, names), fmt::join(names, ", "));
}

std::string to_text(double value) { return fmt::format("{}", value); }

bool from_text(std::string_view text, double& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace rehearse
