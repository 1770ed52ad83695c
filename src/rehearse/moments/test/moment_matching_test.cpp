#include "rehearse/moments/moment_matching.hpp"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "matching_cases.hpp"
#include "rehearse/moments/fitc.hpp"

namespace rehearse::moments {
namespace {

using matching::mixture, matching::matched_moments, matching::Reference;

void expect_agreement(const MomentMatching& matching, const nlohmann::json& test, const nlohmann::json& expected,
                      double tolerance) {
  const Transformed result = matched_moments(matching, {reference::vector(test["m"]), reference::matrix(test["s"])});
  EXPECT_LT(reference::error(result.mean, reference::matrix(expected["M"])), tolerance) << test["hyp"] << test["m"];
  const Matrix covariance = reference::matrix(expected["S"]);
  // The covariance of a known function at a known input is the 1e-6 that PILCO adds; the rest is rounding, 2e-12 in
  // PILCO's own number and 1.1e-11 in ours on one processor.
  const double largest = std::max(covariance.cwiseAbs().maxCoeff(), 2e-4);
  EXPECT_LT((result.covariance - covariance).cwiseAbs().maxCoeff(), tolerance * largest) << test["hyp"] << test["m"];
  EXPECT_LT(reference::error(result.gain, reference::matrix(expected["V"])), tolerance) << test["hyp"] << test["m"];
}

/// PILCO's ridge is 1e-6 whatever the signal.
std::vector<MomentTerm> fitc_as_in_pilco(const Reference& reference, const std::string& name) {
  std::vector<MomentTerm> terms;
  for (const gp::Hyperparameters& theta : reference.hyperparameters(name)) {
    const auto output = static_cast<Index>(terms.size());
    MomentTerm term =
        fitc_terms(reference.X, reference.Y.col(output), reference.Z, {theta}, 1e-6 / theta.signal_variance()).front();
    term.output = output;
    terms.push_back(std::move(term));
  }
  return terms;
}

/// PILCO adds 1e-6 to the variance of a mean alone.
std::vector<MomentTerm> means_as_in_pilco(const gp::Posterior& posterior) {
  std::vector<MomentTerm> terms = mean_terms(exact_terms(posterior));
  for (MomentTerm& term : terms) term.variance = 1e-6;
  return terms;
}

TEST(MomentMatching, AgreesWithPilco) {
  const Reference reference;
  for (const auto& test : reference.data["cases"]) {
    const std::string name = test["hyp"];
    const gp::Posterior posterior = reference.posterior(name);
    expect_agreement({exact_terms(posterior), 4}, test, test["gp0"], 1e-7);
    expect_agreement({means_as_in_pilco(posterior), 4}, test, test["gp2_meanonly"], 1e-7);
    expect_agreement({fitc_as_in_pilco(reference, name), 4}, test, test["gp1_fitc15"], 1e-6);
  }
}

/// A draw by the formulas of moment_term.hpp.
Vector draw(const std::vector<MomentTerm>& terms, const Vector& x, const Vector& normals) {
  Vector y = Vector::Zero(2);
  for (const MomentTerm& t : terms) {
    const Vector inverse = (-t.log_lengths).array().exp();
    Vector c(t.size());
    for (Index i = 0; i < t.size(); ++i)
      c(i) = std::exp(-0.5 * (x - t.centres.row(i).transpose()).cwiseProduct(inverse).squaredNorm());
    y(t.output) += t.weights.dot(c);
    if (t.reduction.size() > 0) y(t.output) += std::sqrt(t.variance - c.dot(t.reduction * c)) * normals(t.output);
  }
  return y;
}

TEST(MomentMatching, AgreesWithSamplesOfAMixture) {
  const std::vector<MomentTerm> terms = mixture(3);
  const Gaussian x = tools::random_gaussian(3, 0.6, 11);
  tools::expect_samples([&](const Vector& at, const Vector& normals) { return draw(terms, at, normals); }, x,
                        matched_moments({terms, 2}, x), 12);
}

/// cov[f(x), g(x)] of two networks, by the product of two Gaussians and explicit inverses.
double plain_covariance(const MomentTerm& f, const MomentTerm& g, const Gaussian& x) {
  const Index D = x.size();
  const Matrix I = Matrix::Identity(D, D);
  const auto squares = [](const MomentTerm& t) -> Matrix {
    return Vector((2 * t.log_lengths).array().exp()).asDiagonal();
  };
  const auto expectation = [&](const Matrix& Lambda, const Vector& centre) {
    const Vector z = centre - x.mean;
    return std::exp(-0.5 * z.dot((x.covariance + Lambda).inverse() * z)) /
           std::sqrt((x.covariance * Lambda.inverse() + I).determinant());
  };
  const Matrix F = squares(f), G = squares(g), both = (F.inverse() + G.inverse()).inverse();
  double product = 0, mean_f = 0, mean_g = 0;
  for (Index i = 0; i < f.size(); ++i) {
    const Vector a = f.centres.row(i).transpose();
    mean_f += f.weights(i) * expectation(F, a);
    for (Index j = 0; j < g.size(); ++j) {
      const Vector b = g.centres.row(j).transpose(), apart = a - b;
      const double overlap = std::exp(-0.5 * apart.dot((F + G).inverse() * apart));
      product += f.weights(i) * g.weights(j) * overlap * expectation(both, both * (F.inverse() * a + G.inverse() * b));
    }
  }
  for (Index j = 0; j < g.size(); ++j) mean_g += g.weights(j) * expectation(G, g.centres.row(j).transpose());
  return product - mean_f * mean_g;
}

// Cutler 2015: M = M_gp + M_prior, S = S_gp + S_prior + C + Cᵀ, V = V_gp + V_prior.
TEST(MomentMatching, OfGpsAroundANetworkIsTheSumOfBothAndWhatTheyShare) {
  const std::vector<MomentTerm> all = mixture(4), gps(all.begin(), all.begin() + 2),
                                network(all.begin() + 2, all.end());
  const Gaussian x = tools::random_gaussian(4, 0.6, 13);
  const Transformed sum = matched_moments({all, 2}, x), gp = matched_moments({gps, 2}, x),
                    prior = matched_moments({network, 2}, x);
  Matrix C(2, 2);
  for (const MomentTerm& f : gps)
    for (const MomentTerm& g : network) C(f.output, g.output) = plain_covariance(f, g, x);
  ASSERT_GT(C.cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT((sum.mean - gp.mean - prior.mean).norm(), 1e-12);
  EXPECT_LT((sum.gain - gp.gain - prior.gain).norm(), 1e-12);
  EXPECT_LT((sum.covariance - gp.covariance - prior.covariance - C - C.transpose()).norm(), 1e-10);
}

TEST(MomentMatching, OfACertainInputIsThePrediction) {
  const Reference reference;
  const gp::Posterior posterior = reference.posterior("perturbed");
  const Gaussian x{reference.X.row(3).transpose(), Matrix::Zero(6, 6)};
  const Transformed result = matched_moments({exact_terms(posterior), 4}, x);
  Matrix mean(1, 4), variance(1, 4);
  posterior.predict(x.mean.transpose(), mean, variance);
  EXPECT_LT((result.mean - mean.transpose()).norm(), 1e-12);
  EXPECT_LT((result.covariance.diagonal() - variance.transpose()).norm(), 1e-12);
}

/// The terms with an input more, which is 0 at all centres.
std::vector<MomentTerm> with_a_constant(std::vector<MomentTerm> terms) {
  for (MomentTerm& term : terms) {
    const Index D = term.inputs();
    term.centres.conservativeResize(Eigen::NoChange, D + 1);
    term.centres.col(D).setZero();
    term.log_lengths.conservativeResize(D + 1);
    term.log_lengths(D) = 0;
  }
  return terms;
}

// With 7 and 9 inputs the loops have a known length, with 8 and 10 any.
TEST(MomentMatching, IsTheSameWithAnInputMoreThatIsConstant) {
  for (const Index D : {7, 9}) {
    const std::vector<MomentTerm> terms = mixture(D, 30);
    const Gaussian x = tools::random_gaussian(D, 0.5, 52);
    Gaussian longer = Gaussian::zero(D + 1);
    longer.mean.head(D) = x.mean;
    longer.covariance.topLeftCorner(D, D) = x.covariance;
    const Transformed known = matched_moments({terms, 2}, x),
                      any = matched_moments({with_a_constant(terms), 2}, longer);
    EXPECT_LT((known.mean - any.mean).norm(), 1e-12);
    EXPECT_LT((known.covariance - any.covariance).norm(), 1e-12);
    EXPECT_LT((known.gain - any.gain.topRows(D)).norm(), 1e-12);
  }
}

TEST(MomentMatching, IsTheSameForAnyNumberOfThreads) {
  const MomentMatching matching(mixture(6, 150), 2);
  const Gaussian x = tools::random_gaussian(6, 0.5, 51);
  const Transformed one = matched_moments(matching, x);
  const auto threads = make_thread_evaluator(3);
  MomentTape tape;
  Transformed three;
  ASSERT_TRUE(matching.forward(x, tape, three, *threads));
  EXPECT_EQ(one.mean, three.mean);
  EXPECT_EQ(one.covariance, three.covariance);
  EXPECT_EQ(one.gain, three.gain);
}

TEST(MomentMatching, SaysWhatIsNoGaussian) {
  const MomentMatching matching(mixture(3), 2);
  MomentTape tape;
  Transformed result;
  for (const double bad : {kNaN, kInf, -kInf}) {
    Gaussian x = tools::random_gaussian(3, 1, 61);
    x.mean(1) = bad;
    EXPECT_FALSE(matching.forward(x, tape, result));
    x = tools::random_gaussian(3, 1, 61);
    x.covariance(0, 2) = bad;
    EXPECT_FALSE(matching.forward(x, tape, result));
  }
  EXPECT_FALSE(matching.forward({Vector::Zero(3), -100 * Matrix::Identity(3, 3)}, tape, result));
  for (const double huge : {1e3, 1e100, 1e200}) {
    Gaussian x = tools::random_gaussian(3, 1, 62);
    x.mean(0) = huge;
    ASSERT_TRUE(matching.forward(x, tape, result)) << huge;
    EXPECT_EQ(result.mean, Vector::Zero(2)) << "far from all data";
    EXPECT_NEAR(result.covariance(0, 0), 1.2 * 1.2, 1e-12);
  }
}

TEST(MomentMatching, LengthScalesOutOfAllProportionStayFinite) {
  std::vector<MomentTerm> terms = mixture(3);
  const Gaussian x = tools::random_gaussian(3, 1, 63);
  for (MomentTerm& term : terms) term.log_lengths(2) = 400;  // an input that does not matter
  const Transformed result = matched_moments({terms, 2}, x);
  for (MomentTerm& term : terms) term.log_lengths(2) = 20;
  const Transformed nearly = matched_moments({terms, 2}, x);
  EXPECT_LT((result.mean - nearly.mean).norm(), 1e-12);
  EXPECT_LT((result.covariance - nearly.covariance).norm(), 1e-12);
  for (MomentTerm& term : terms) term.log_lengths(2) = -400;  // no two points are alike
  EXPECT_LT(matched_moments({terms, 2}, x).mean.norm(), 1e-90);
}

}  // namespace
}  // namespace rehearse::moments
