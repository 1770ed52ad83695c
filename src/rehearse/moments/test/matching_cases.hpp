#pragma once
// GPs of PILCO's own numbers, and terms of all kinds.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rehearse/core/test/reference.hpp"
#include "rehearse/gp/test/naive.hpp"
#include "rehearse/moments/moment_matching.hpp"
#include "rehearse/moments/test/gaussian_tools.hpp"

namespace rehearse::moments::matching {

struct Reference {
  nlohmann::json data = reference::load("b_gp_moment_matching.json");
  Matrix X = reference::matrix(data["inputs"]["X"]), Y = reference::matrix(data["inputs"]["Y"]),
         Z = reference::matrix(data["inputs"]["Z_inducing"]);

  std::vector<gp::Hyperparameters> hyperparameters(const std::string& name) const {
    const Matrix flat = reference::matrix(data["inputs"]["loghyp_" + name]);
    std::vector<gp::Hyperparameters> list;
    for (Index e = 0; e < flat.cols(); ++e)
      list.push_back(gp::Hyperparameters::from_flat(flat.col(e), flat.rows() - 2));
    return list;
  }
  gp::Posterior posterior(const std::string& name) const { return {gp::Inputs(X), Y, hyperparameters(name)}; }
};

inline Transformed matched_moments(const MomentMatching& matching, const Gaussian& x) {
  MomentTape tape;
  Transformed result;
  EXPECT_TRUE(matching.forward(x, tape, result));
  return result;
}

/// Terms of all kinds for two outputs: GPs with a prior mean, and one that shares the centres of another.
inline std::vector<MomentTerm> mixture(Index D, Index n = 12) {
  const Matrix X = gp::naive::normals(n, D, 1);
  const std::vector<gp::Hyperparameters> theta{gp::naive::hyperparameters(D, 1.5, 1.2, 0.3),
                                               gp::naive::hyperparameters(D, 2.5, 0.8, 0.2)};
  Matrix Y(n, 2);
  for (Index e = 0; e < 2; ++e)
    Y.col(e) = gp::naive::draw(X, theta[static_cast<std::size_t>(e)], 2 + static_cast<std::uint64_t>(e));
  std::vector<MomentTerm> terms = exact_terms({gp::Inputs(X), Y, theta});
  for (Index e = 0; e < 2; ++e)
    terms.push_back({.output = e,
                     .centres = gp::naive::normals(n - 3 + e, D, 5 + static_cast<std::uint64_t>(e)),
                     .log_lengths = Vector::Constant(D, 0.3),
                     .weights = gp::naive::normals(n - 3 + e, 1, 7 + static_cast<std::uint64_t>(e))});
  return terms;
}

}  // namespace rehearse::moments::matching
