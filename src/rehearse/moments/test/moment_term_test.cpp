#include "rehearse/moments/moment_term.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "matching_cases.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/moments/fitc.hpp"

namespace rehearse::moments {
namespace {

using matching::mixture, matching::matched_moments, matching::Reference;

TEST(MomentTerm, ExactTermsAreThePosteriorsOwnNumbers) {
  const Reference reference;
  const gp::Posterior posterior = reference.posterior("perturbed");
  const std::vector<MomentTerm> terms = exact_terms(posterior);
  ASSERT_EQ(terms.size(), 4u);
  const Matrix X = reference.X.topRows(5), values = evaluate_means(terms, 4, X);
  Matrix mean(5, 4), variance(5, 4);
  posterior.predict(X, mean, variance);
  EXPECT_LT((values - mean).cwiseAbs().maxCoeff(), 1e-12);
  for (const MomentTerm& term : terms) {
    EXPECT_LT((term.centres - reference.X).cwiseAbs().maxCoeff(), 1e-12);
    for (Index i = 0; i < 5; ++i) {
      const Vector c =
          (-0.5 * ((term.centres.rowwise() - X.row(i)) * (-term.log_lengths).array().exp().matrix().asDiagonal())
                      .rowwise()
                      .squaredNorm()
                      .array())
              .exp();
      EXPECT_NEAR(term.variance - c.dot(term.reduction * c), variance(i, term.output), 1e-9);
    }
  }
}

TEST(MomentTerm, MeanTermsKeepTheMeansAlone) {
  const Reference reference;
  const auto fitc = fitc_terms(reference.X, reference.Y, reference.Z, reference.hyperparameters("perturbed"));
  const auto means = mean_terms(fitc);
  const Matrix at = reference.X.topRows(3), values = evaluate_means(means, 4, at);
  for (Index i = 0; i < 3; ++i) {
    const Gaussian x{at.row(i).transpose(), Matrix::Zero(6, 6)};
    const Transformed full = matched_moments({fitc, 4}, x), mean = matched_moments({means, 4}, x);
    EXPECT_EQ(full.mean, mean.mean);
    EXPECT_LT(mean.covariance.diagonal().cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((mean.mean - values.row(i).transpose()).norm(), 1e-12);
  }
}

TEST(MomentTerm, RefusesWhatDoesNotFit) {
  std::vector<MomentTerm> terms = mixture(3);
  EXPECT_THROW(MomentMatching(terms, 1), InvalidInput);
  EXPECT_THROW(MomentMatching(terms, 2, true), InvalidInput) << "no adjoint of GPs";
  terms[0].weights(0) = std::nan("");
  EXPECT_THROW(MomentMatching(terms, 2), InvalidInput);
  EXPECT_THROW(MomentMatching({}, 2), InvalidInput);
}

}  // namespace
}  // namespace rehearse::moments
