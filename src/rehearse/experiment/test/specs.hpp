#pragma once
// Specs of the line, and what is wrong with them.

#include <string>
#include <utility>
#include <vector>

#include "fake.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/resolve.hpp"

namespace rehearse::experiment::specs {

using Options = std::vector<std::pair<std::string, std::string>>;

inline Spec spec_of(const std::string& learner, const std::string& prior = "", const Options& options = {}) {
  return {.scenario = "line", .learner = learner, .prior = prior, .options = options};
}

inline std::string complaint(const Spec& spec) {
  return fake::message_of<InvalidInput>([&] { resolve(fake::catalogue(), spec); });
}

}  // namespace rehearse::experiment::specs
