#pragma once
// The slider as ite meets it, with an archive that is made in a moment.

#include <map>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/learners/ite/ite.hpp"
#include "rehearse/learners/test/slider.hpp"
#include "rehearse/policy/network.hpp"

namespace rehearse::learners::ite {

using OptionTexts = std::map<std::string, std::string>;

// The slider; how it went is where it was half way and in the end.
inline Task task() {
  Task task = slider::task();
  task.descriptor = [](const Episode& e) {
    return Vector{{e.true_states(e.steps() / 2, 0), e.true_states(e.steps(), 0)}};
  };
  task.descriptor_bounds = {{-2, 2}, {-2, 2}};
  return task;
}

inline Setting setting(double gain = 1, std::uint64_t seed = 1) {
  Setting setting;
  setting.task = task();
  setting.policy =
      policy::make_linear({.features = setting.task.feature_map(), .scale = Vector::Ones(1), .squash = {{{-1, 1}}, 1}});
  setting.prior = slider::prior(gain);
  setting.seed = seed;
  return setting;
}

inline Episode run_trial(const Proposal& proposal, std::uint64_t trial) {
  return slider::run_trial_on(Vector{{0.6, 0.2}}, proposal, trial);
}

inline std::unique_ptr<LearnerBuilder> builder(const OptionTexts& options = {}) {
  auto builder = std::move(builders().front());
  OptionTexts all{{"archive.niches", "200"},
                  {"archive.evaluations", "2000"},
                  {"archive.search.batch", "128"},
                  {"archive.search.initial", "256"},
                  {"adaptation.length", "0.1"}};
  for (const auto& [name, text] : options) all[name] = text;
  for (const auto& [name, text] : all)
    EXPECT_TRUE(set_field([&](FieldVisitor& v) { builder->fields(v); }, name, text)) << name;
  return builder;
}

inline std::string refusal(const Setting& setting) {
  try {
    builder()->build(setting)->ask();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

}  // namespace rehearse::learners::ite
