#include "rehearse/campaign/folder_name.hpp"

#include <gtest/gtest.h>

namespace rehearse::campaign {
namespace {

TEST(FolderName, SaysWhatTheRunIsAndIsOneFolderOnEveryFileSystem) {
  EXPECT_EQ(folder_name({.scenario = "cart", .learner = "mi", .prior = "a,b", .seed = 7}, "fast,x=1"),
            "cart-mi-a,b-fast,x=1-7");
  EXPECT_EQ(folder_name({.scenario = "cart", .learner = "pilco", .seed = 1}, ""), "cart-pilco-none-1");
  EXPECT_EQ(folder_name({.scenario = "cart", .learner = "pilco", .seed = 1}, "a/b c:ü"), "cart-pilco-none-a_b_c___-1");
}

}  // namespace
}  // namespace rehearse::campaign
