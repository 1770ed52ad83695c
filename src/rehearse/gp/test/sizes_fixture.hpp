#pragma once
// GPs of sizes that tests of wrong sizes know.

#include <string>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/gp/posterior.hpp"
#include "rehearse/gp/test/naive.hpp"

namespace rehearse::gp {

template <class Call>
std::string complaint(Call call) {
  try {
    call();
  } catch (const InvalidInput& wrong) {
    return wrong.what();
  }
  return "none";
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

struct SizesFixture : ::testing::Test {
  Matrix X = naive::normals(12, 3, 1), Y = naive::normals(12, 2, 2);
  Inputs inputs{X};
  Hyperparameters theta = naive::hyperparameters(3, 1, 1, 0.1);
  Posterior posterior{inputs, Y, {theta, theta}};
};

}  // namespace rehearse::gp
