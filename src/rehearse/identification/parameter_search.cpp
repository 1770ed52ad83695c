#include "rehearse/identification/parameter_search.hpp"

namespace rehearse::identification {
namespace {

std::vector<Interval> box_of(const ParameterSpace& space, const std::vector<Index>& continuous) {
  std::vector<Interval> box;
  for (Index i : continuous) box.push_back(space[i].box);
  return box;
}

}  // namespace

std::vector<Vector> choices_of(const ParameterSpace& space, const std::vector<Index>& discrete) {
  std::vector<std::vector<double>> choices;
  for (Index i : discrete) choices.push_back(space[i].choices);
  return optim::combinations(choices);
}

Identified identify(const ParameterSpace& space, const std::optional<Vector>& start,
                    const optim::ScalarObjective& score, const optim::SubplexOptions& options) {
  const std::vector<Index> continuous = space.of_kind(Parameter::Kind::continuous);
  const std::vector<Index> discrete = space.of_kind(Parameter::Kind::discrete);
  Identified best{.phi = start.value_or(space.values()), .score = -kInf};
  const Vector first = best.phi;
  const auto consider = [&](const Vector& phi, double value, Index evaluations) {
    best.evaluations += evaluations;
    if (value > best.score) best.score = value, best.phi = phi;
  };
  for (const Vector& choice : choices_of(space, discrete)) {
    Vector phi = first;
    phi(discrete) = choice;
    if (continuous.empty()) {
      consider(phi, score(phi), 1);
      continue;
    }
    const auto objective = [&](const Vector& x) {
      Vector at = phi;
      at(continuous) = x;
      return score(at);
    };
    const auto result = optim::maximise_subplex(objective, phi(continuous), box_of(space, continuous), options);
    phi(continuous) = result.x;
    consider(phi, result.value, result.evaluations);
  }
  return best;
}

}  // namespace rehearse::identification
