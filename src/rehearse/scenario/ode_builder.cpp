#include "rehearse/scenario/ode_builder.hpp"

#include "rehearse/core/errors.hpp"

namespace rehearse::scenario {
namespace {

class OdeBuilder final : public ScenarioBuilder {
 public:
  OdeBuilder(std::string summary, OdeScenario parts, const OdeOptions& options)
      : summary_(std::move(summary)), parts_(std::move(parts)), options_(options), plant_(parts_.plant.all()) {
    if (parts_.policy_scale.size() == 0) parts_.policy_scale = Vector::Ones(parts_.task.feature_map().features());
  }

  std::string name() const override { return parts_.name; }
  std::string summary() const override { return summary_; }

  std::vector<std::string> prior_names() const override {
    std::vector<std::string> names;
    for (const Guess& guess : parts_.guesses) names.push_back(guess.name);
    return names;
  }

  void fields(FieldVisitor& v) override { options_.fields_of_robot(v, plant_); }

  Scenario build() const override {
    if (const auto wrong = parts_.task.violations(); !wrong.empty()) throw InvalidInput(wrong);
    OdeScenario parts = parts_;
    parts.plant = ParameterSpace(plant_);
    return make_ode_scenario(parts, options_);
  }

 private:
  std::string summary_;
  OdeScenario parts_;
  OdeOptions options_;
  std::vector<Parameter> plant_;
};

}  // namespace

std::unique_ptr<ScenarioBuilder> make_ode_builder(std::string summary, OdeScenario parts, const OdeOptions& options) {
  auto builder = std::make_unique<OdeBuilder>(std::move(summary), std::move(parts), options);
  builder->build();  // says what is wrong
  return builder;
}

}  // namespace rehearse::scenario
