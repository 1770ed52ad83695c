#include "rehearse/learners/black_drops/safety.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/statistics/intervals.hpp"

namespace rehearse::learners::black_drops {
namespace {

constexpr Index kDoubted = 20;  // priors; a divisor of the usual numbers of rollouts

Vector drawn(const ParameterSpace& space, double doubt, Rng& rng) {
  Vector phi = space.values();
  for (Index i = 0; i < space.size(); ++i) {
    const Parameter& parameter = space[i];
    if (parameter.kind == Parameter::Kind::continuous)
      phi(i) += doubt * (rng.uniform(parameter.box.low, parameter.box.high) - phi(i));
    if (parameter.kind == Parameter::Kind::discrete)
      phi(i) = parameter.choices[static_cast<std::size_t>(rng.below(static_cast<Index>(parameter.choices.size())))];
  }
  return phi;
}

}  // namespace

void SafetyOptions::fields(FieldVisitor& v) {
  v.integer("rollouts", rollouts, expert("tasks with limits: rollouts of each policy that is compared"),
            between(1, 1e6));
  v.integer("searches", searches,
            "tasks with limits: largest number of further searches for safe policies near good ones", between(0, 1000));
  v.number("caution", caution, "tasks with limits: risks are judged with so many times the model's deviations",
           between(1, 100));
  v.number("doubt", doubt,
           "tasks with limits, before data: range of the prior's parameters, as a fraction of their bounds",
           between(0, 1));
  v.boolean("explore", explore,
            "limits, no prior: safe random actions are tried if no safe policy is predicted to improve");
}

double excess(const std::vector<LimitRisk>& risks, const std::vector<Limit>& limits) {
  double most = 0;
  for (std::size_t l = 0; l < risks.size(); ++l)
    most = std::max(most, statistics::rate_interval(risks[l].broken, risks[l].episodes).high - limits[l].risk);
  return most;
}

std::vector<std::string> warnings(const std::vector<LimitRisk>& risks, const std::vector<Limit>& limits) {
  std::vector<std::string> lines;
  for (std::size_t l = 0; l < risks.size(); ++l) {
    const auto [low, high] = statistics::rate_interval(risks[l].broken, risks[l].episodes);
    if (high <= limits[l].risk) continue;
    lines.push_back(
        fmt::format("the safest policy found may not be safe enough: {:.3g} to {:.3g} % of its episodes are expected "
                    "to break the limit {}, which allows {:.3g} %",
                    100 * low, 100 * high, limits[l].name, 100 * limits[l].risk));
  }
  return lines;
}

std::vector<std::shared_ptr<const dynamics::DynamicsModel>> doubted(const prior::Prior& prior, double doubt,
                                                                    StreamKey key) {
  std::vector<std::shared_ptr<const dynamics::DynamicsModel>> models;
  if (doubt == 0 || !prior.space.has_tunable()) return models;
  key.purpose = Purpose::doubt;
  Rng rng(key);
  for (Index i = 0; i < kDoubted; ++i)
    models.push_back(std::make_shared<dynamics::SimulatorModel>(prior, drawn(prior.space, doubt, rng)));
  return models;
}

}  // namespace rehearse::learners::black_drops
