#pragma once
// The learner without a prior, and what it proposes after some trials on the slider.

#include <map>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "slider.hpp"

namespace rehearse::learners::pilco::slider {

using OptionTexts = std::map<std::string, std::string>;

inline std::unique_ptr<LearnerBuilder> builder(const OptionTexts& options = {{"search.line_searches", "20"}}) {
  auto builder = std::move(builders().front());
  for (const auto& [name, text] : options)
    EXPECT_TRUE(set_field([&](FieldVisitor& v) { builder->fields(v); }, name, text)) << name;
  return builder;
}

/// The last proposal of some trials, and the data that it was learned from.
struct Asked {
  Proposal proposal;
  Dataset data;
};
inline Asked asked_after(std::uint64_t trials, const OptionTexts& options) {
  const auto learner = builder(options)->build(setting());
  Dataset data;
  for (std::uint64_t trial = 1; trial <= trials; ++trial) {
    const Episode episode = run_trial(learner->ask(), trial);
    data.append(episode);
    learner->tell(episode);
  }
  return {learner->ask(), data};
}

}  // namespace rehearse::learners::pilco::slider
