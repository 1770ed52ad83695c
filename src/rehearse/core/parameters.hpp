#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse {

/// One parameter of a simulator: fixed, tunable in a box, or tunable in a finite set.
struct Parameter {
  enum class Kind { fixed, continuous, discrete };

  std::string name;
  std::string unit;
  double value = 0;  // of a fixed parameter its value, of a tunable one where its search starts
  Kind kind = Kind::fixed;
  Interval box;                 // continuous
  std::vector<double> choices;  // discrete

  static Parameter fixed(std::string name, double value, std::string unit = "");
  static Parameter continuous(std::string name, double value, Interval box, std::string unit = "");
  static Parameter discrete(std::string name, double value, std::vector<double> choices, std::string unit = "");

  bool tunable() const { return kind != Kind::fixed; }
};

/// All parameters of a simulator in a fixed order. φ is the vector of all their values, fixed ones included.
class ParameterSpace {
 public:
  ParameterSpace() = default;
  explicit ParameterSpace(std::vector<Parameter> parameters);  // throws InvalidInput on a bad or repeated parameter

  Index size() const { return static_cast<Index>(parameters_.size()); }
  const std::vector<Parameter>& all() const { return parameters_; }
  const Parameter& operator[](Index i) const { return parameters_[static_cast<std::size_t>(i)]; }
  Vector values() const;

  Index find(std::string_view name) const;  // −1 if there is none
  std::vector<std::string> names() const;
  std::vector<Index> of_kind(Parameter::Kind kind) const;
  bool has_tunable() const;

  /// Throws InvalidInput if there is no such parameter or the value is outside its box or set.
  void set_value(std::string_view name, double value);

  /// The same parameters, those of these names tunable in the box. Throws InvalidInput as above.
  ParameterSpace tunable_in(Interval box, const std::vector<std::string>& names) const;

  /// The same parameters, all fixed at phi.
  ParameterSpace fixed_at(const Vector& phi) const;

 private:
  Parameter& at(std::string_view name);

  std::vector<Parameter> parameters_;
};

}  // namespace rehearse
