#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rehearse/core/errors.hpp"
#include "rehearse/prior/prior.hpp"
#include "rehearse/scenario/scenario.hpp"

namespace rehearse::experiment {

/// "a,b,c" → its names; empty text: none.
std::vector<std::string> split_names(const std::string& text);

/// "prior.NAME" of "prior.PRIOR.NAME", where that is the prior; another key as it is.
std::string without_prior(const std::string& key, const std::string& prior);

/// The value of tunable parameter `i` for people: where `names` are several priors the first is the chosen one, whose
/// name it is.
std::string phi_text(const std::string& names, std::size_t i, double value);

/// "unknown option 'x', did you mean 'y'?"; `of`: what `list` shows options of.
std::string unknown_option(const std::string& key, const std::vector<std::string>& known,
                           const std::string& of = "a robot or learner");

/// The priors that a spec names, with the values that their parameters start from.
class ChosenPriors {
 public:
  /// Unknown names become violations.
  ChosenPriors(const scenario::Scenario& scenario, const std::vector<std::string>& names, Violations& violations);

  /// key: NAME sets it in every prior that has it, PRIOR.NAME in one.
  void set(const std::string& key, const std::string& text, Violations& violations);

  /// Every value that can be set, as `prior.KEY` and text.
  std::vector<std::pair<std::string, std::string>> values() const;

  /// Nothing, the one prior, or their choice.
  std::optional<prior::Prior> prior() const;

 private:
  std::vector<scenario::NamedPrior*> having(const std::string& key, std::string& parameter);
  std::vector<std::string> keys() const;

  std::vector<scenario::NamedPrior> priors_;
};

}  // namespace rehearse::experiment
