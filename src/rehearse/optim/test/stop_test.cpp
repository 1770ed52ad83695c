#include "rehearse/optim/stop.hpp"

#include <set>

#include <gtest/gtest.h>

namespace rehearse::optim {
namespace {

TEST(Stop, HasWordsOfItsOwnForEveryReason) {
  std::set<std::string> words;
  for (int reason = static_cast<int>(Stop::none); reason <= static_cast<int>(Stop::max_generations); ++reason)
    words.insert(to_string(static_cast<Stop>(reason)));
  EXPECT_EQ(words.size(), 8u);
  EXPECT_EQ(words.count("unknown"), 0u);
}

}  // namespace
}  // namespace rehearse::optim
