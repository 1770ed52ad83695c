#include "rehearse/gp/correlations.hpp"

#include <gtest/gtest.h>

#include "naive.hpp"

namespace rehearse::gp {
namespace {

TEST(Covariance, AgreesWithTheBook) {
  const Matrix X = 2 * naive::normals(30, 4, 1).array() + 1;
  const Hyperparameters none = naive::hyperparameters(4, 2, 1.5, 0.3);
  for (const Hyperparameters& theta : {none, naive::with_trend(none, 0.5)}) {
    const Matrix expected = naive::covariance(X, X, theta);
    EXPECT_LT((covariance(X, theta) - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
  }
}

}  // namespace
}  // namespace rehearse::gp
