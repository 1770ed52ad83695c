#include "rehearse/experiment/memory.hpp"

#include <gtest/gtest.h>

#include "fake.hpp"
#include "rehearse/experiment/resolve.hpp"

namespace rehearse::experiment {
namespace {

TEST(Memory, NamesTheLargestSizesThatWereAskedFor) {
  const Catalogue catalogue = fake::catalogue();
  Spec spec = completed(catalogue, {.scenario = "line", .learner = "echo", .prior = "near"});
  const std::string begin = "there is not enough memory; the largest sizes that are asked for: ";
  const auto set = [&](const std::string& name, const std::string& text) {
    for (auto& [key, value] : spec.options)
      if (key == name) value = text;
  };
  EXPECT_EQ(not_enough_memory(catalogue, spec).find(begin), 0u);
  set("scenario.noise", "0.5");
  set("scenario.evaluations", "123456789");
  EXPECT_EQ(not_enough_memory(catalogue, spec), begin + "scenario.evaluations = 123456789");
  set("learner.search.step", "7");
  EXPECT_EQ(not_enough_memory(catalogue, spec), begin + "scenario.evaluations = 123456789, learner.search.step = 7");
}

}  // namespace
}  // namespace rehearse::experiment
