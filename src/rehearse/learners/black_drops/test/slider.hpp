#pragma once
// The slider of all learners with a linear policy.

#include <memory>
#include <string>

#include "rehearse/learners/black_drops/black_drops.hpp"
#include "rehearse/learners/test/slider.hpp"
#include "rehearse/policy/network.hpp"

namespace rehearse::learners::black_drops::slider {

using learners::slider::History, learners::slider::kTruth, learners::slider::learn, learners::slider::prior,
    learners::slider::run_trial, learners::slider::task;

inline std::shared_ptr<const policy::Policy> policy() {
  return policy::make_linear(
      {.features = FeatureMap({StateKind::plain}), .scale = Vector::Ones(1), .squash = {{{-1, 1}}, 1}});
}

inline Setting setting(std::optional<prior::Prior> prior = slider::prior(), std::uint64_t seed = 1) {
  Setting setting;
  setting.task = task();
  setting.policy = policy();
  setting.prior = std::move(prior);
  setting.seed = seed;
  return setting;
}

/// The learner of this name, with a small budget of rollouts.
inline std::unique_ptr<LearnerBuilder> builder(const std::string& name, const std::string& evaluations = "300") {
  for (auto& builder : builders()) {
    if (builder->name() != name) continue;
    const Fields fields = [&](FieldVisitor& v) { builder->fields(v); };
    for (const auto& [field, value] : {std::pair<std::string, std::string>{"search.race.max_evaluations", evaluations},
                                       {"search.race.descents", "4"},
                                       {"search.race.rounds", "2"},
                                       {"search.race.judgements", "4"},
                                       {"search.race.cmaes.population", "8"},
                                       {"search.finalists", "2"},
                                       {"search.selection", "10"}})
      if (!set_field(fields, field, value)) return nullptr;
    return std::move(builder);
  }
  return nullptr;
}

inline const char* const kNames[] = {"black-drops", "black-drops-prior", "gp-mi", "mi"};
inline const char* const kWithPrior[] = {"black-drops-prior", "gp-mi", "mi"};

}  // namespace rehearse::learners::black_drops::slider
