#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rehearse/scenario/scenario.hpp"

namespace rehearse::scenario {

/// Builds scenarios from a struct of options with fields().
template <class Options>
class OptionsBuilder final : public ScenarioBuilder {
 public:
  using Make = Scenario (*)(const Options&);
  OptionsBuilder(std::string summary, Make make)
      : summary_(std::move(summary)), make_(make), by_default_(make(options_)) {}

  std::string name() const override { return by_default_.name; }
  std::string summary() const override { return summary_; }
  std::vector<std::string> prior_names() const override {
    std::vector<std::string> names;
    for (const NamedPrior& prior : by_default_.priors) names.push_back(prior.name);
    return names;
  }
  void fields(FieldVisitor& v) override { options_.fields(v); }
  Scenario build() const override { return make_(options_); }

 private:
  std::string summary_;
  Make make_;
  Options options_;
  Scenario by_default_;
};

/// `make` must give the scenario the same name and priors of the same names whatever the options.
template <class Options>
std::unique_ptr<ScenarioBuilder> make_builder(std::string summary, Scenario (*make)(const Options&)) {
  return std::make_unique<OptionsBuilder<Options>>(std::move(summary), make);
}

}  // namespace rehearse::scenario
