#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "rehearse/expression/tape_builder.hpp"

namespace rehearse::expression {

/// Use it to compile formulas that people write: "(u - b * dq) / (m * l^2)". They may use numbers, the names that are
/// given, definitions (names for formulas), pi, + - * / ^, comparisons, && and ||, and the functions of
/// `function_names`: where(condition, a, b) is a where the condition holds, else b. Truth is 1 or 0.
///
/// The grammar is muParser's. Not thread-safe; programs made from it are.
class Formulas {
 public:
  /// Throws InvalidInput if the name is none, or taken.
  Node input(const std::string& name, Pace pace);
  void define(const std::string& name, const std::string& formula);

  /// A name that other formulas know. A formula here that uses it is refused: "'NAME' why".
  void elsewhere(const std::string& name, const std::string& why);

  /// Throws InvalidInput with the place in the formula, or the definition, that is wrong.
  Node compile(const std::string& formula);

  /// The same of a formula that is true or false. Throws InvalidInput, too, if it is a number.
  Node compile_condition(const std::string& formula);

  /// The value of a name: an input or a definition; as `compile`.
  Node named(const std::string& name);

  TapeBuilder& builder() { return builder_; }
  const TapeBuilder& builder() const { return builder_; }

  static const std::vector<std::string>& function_names();

 private:
  struct Definition {
    std::string formula;
    Node node = TapeBuilder::kNone;
  };

  void check_name(const std::string& name) const;
  Node compiled(Definition& definition, const std::string& name);
  [[noreturn]] void throw_unknown(const std::string& name) const;

  TapeBuilder builder_;
  std::map<std::string, Node, std::less<>> inputs_;
  std::map<std::string, Definition, std::less<>> definitions_;
  std::map<std::string, std::string, std::less<>> elsewhere_;
  std::vector<std::string> under_way_;  // definitions, each needed by the one before
};

}  // namespace rehearse::expression
