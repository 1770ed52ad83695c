#include "rehearse/moments/moment_matching.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/test/reference.hpp"
#include "rehearse/gp/test/naive.hpp"
#include "rehearse/moments/fitc.hpp"
#include "rehearse/moments/test/gaussian_tools.hpp"

namespace rehearse::moments {
namespace {

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

Transformed moments(const MomentMatching& matching, const Gaussian& x) {
  MomentTape tape;
  Transformed result;
  EXPECT_TRUE(matching.forward(x, tape, result));
  return result;
}

void expect_agreement(const MomentMatching& matching, const nlohmann::json& test, const nlohmann::json& expected,
                      double tolerance) {
  const Transformed result = moments(matching, {reference::vector(test["m"]), reference::matrix(test["s"])});
  EXPECT_LT(reference::error(result.mean, reference::matrix(expected["M"])), tolerance) << test["hyp"] << test["m"];
  const Matrix covariance = reference::matrix(expected["S"]);
  // Of a known function at a known input only the 1e-6 are left that PILCO adds: what comes before is rounding, of
  // which PILCO's own number has 2e-12 and ours 1.1e-11 on one processor.
  const double largest = std::max(covariance.cwiseAbs().maxCoeff(), 2e-4);
  EXPECT_LT((result.covariance - covariance).cwiseAbs().maxCoeff(), tolerance * largest) << test["hyp"] << test["m"];
  EXPECT_LT(reference::error(result.gain, reference::matrix(expected["V"])), tolerance) << test["hyp"] << test["m"];
}

TEST(MomentMatching, AgreesWithPilco) {
  const Reference reference;
  for (const auto& test : reference.data["cases"]) {
    const std::string name = test["hyp"];
    const gp::Posterior posterior = reference.posterior(name);
    expect_agreement({exact_terms(posterior), 4}, test, test["gp0"], 1e-7);
    expect_agreement({mean_terms(posterior, 1e-6), 4}, test, test["gp2_meanonly"], 1e-7);
    expect_agreement({fitc_terms(reference.X, reference.Y, reference.Z, reference.hyperparameters(name)), 4}, test,
                     test["gp1_fitc15"], 1e-6);
  }
}

/// Terms of all kinds for two outputs: GPs with a prior mean, and one that shares the centres of another.
std::vector<MomentTerm> mixture(Index D, Index n = 12) {
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

/// By the formulas of moment_term.hpp.
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
                        moments({terms, 2}, x), 12);
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
  const Transformed sum = moments({all, 2}, x), gp = moments({gps, 2}, x), prior = moments({network, 2}, x);
  Matrix C(2, 2);
  for (const MomentTerm& f : gps)
    for (const MomentTerm& g : network) C(f.output, g.output) = plain_covariance(f, g, x);
  ASSERT_GT(C.cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT((sum.mean - gp.mean - prior.mean).norm(), 1e-12);
  EXPECT_LT((sum.gain - gp.gain - prior.gain).norm(), 1e-12);
  EXPECT_LT((sum.covariance - gp.covariance - prior.covariance - C - C.transpose()).norm(), 1e-10);
}

TEST(MomentMatching, MeanTermsKeepTheMeansOfTermsAlone) {
  const Reference reference;
  const auto fitc = fitc_terms(reference.X, reference.Y, reference.Z, reference.hyperparameters("perturbed"));
  const auto means = mean_terms(fitc, 1e-6);
  const Matrix at = reference.X.topRows(3), values = evaluate_means(means, 4, at);
  for (Index i = 0; i < 3; ++i) {
    const Gaussian x{at.row(i).transpose(), Matrix::Zero(6, 6)};
    const Transformed full = moments({fitc, 4}, x), mean = moments({means, 4}, x);
    EXPECT_EQ(full.mean, mean.mean);
    EXPECT_LT((mean.covariance.diagonal().array() - 1e-6).abs().maxCoeff(), 1e-12);
    EXPECT_LT((mean.mean - values.row(i).transpose()).norm(), 1e-12);
  }
}

TEST(MomentMatching, AdjointAgreesWithDifferencesForAnyNumberOfInputs) {
  for (const Index D : {1, 2, 3, 4, 5, 6, 7, 9}) {
    for (const bool few : {false, true}) {
      const MomentMatching matching(mixture(D, few ? 4 : 21), 2);
      const Gaussian x = tools::random_gaussian(D, 0.4, 21);
      const Transformed by = tools::random_adjoint(D, 2, 22);
      MomentTape tape;
      Transformed result;
      ASSERT_TRUE(matching.forward(x, tape, result));
      Gaussian adjoint = Gaussian::zero(D);
      matching.adjoint(x, tape, result, by, adjoint);
      tools::expect_slopes([&](const Gaussian& at) { return tools::inner(by, moments(matching, at)); }, x, adjoint);
    }
  }
}

/// Networks without uncertainty for two outputs.
std::vector<MomentTerm> networks(Index D) {
  std::vector<MomentTerm> terms;
  for (Index k = 0; k < 3; ++k) {
    const auto seed = static_cast<std::uint64_t>(k);
    terms.push_back({.output = k % 2,
                     .centres = gp::naive::normals(9 + (k == 2 ? 4 : 0), D, 31 + (k == 2 ? 1u : 0u)),
                     .log_lengths = 0.3 * gp::naive::normals(D, 1, 33 + seed),
                     .weights = gp::naive::normals(9 + (k == 2 ? 4 : 0), 1, 36 + seed)});
  }
  return terms;
}

TEST(MomentMatching, AdjointOfTheTermsAgreesWithDifferences) {
  const std::vector<MomentTerm> terms = networks(5);
  const MomentMatching matching(terms, 2, true);
  const Gaussian x = tools::random_gaussian(5, 0.5, 41);
  const Transformed by = tools::random_adjoint(5, 2, 42);
  MomentTape tape;
  Transformed result;
  ASSERT_TRUE(matching.forward(x, tape, result));
  Gaussian adjoint = Gaussian::zero(5);
  std::vector<TermAdjoint> adjoints = matching.zero_adjoints();
  matching.adjoint(x, tape, result, by, adjoint, &adjoints);
  tools::expect_slopes([&](const Gaussian& at) { return tools::inner(by, moments(matching, at)); }, x, adjoint);
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const auto expect = [&](const Vector& start, const Vector& value, auto set) {
      const Vector expected = tools::slopes(
          [&](const Vector& at) {
            std::vector<MomentTerm> moved = terms;
            set(moved[k], at);
            return tools::inner(by, moments({moved, 2}, x));
          },
          start, 1e-3);
      EXPECT_LT((value - expected).norm(), 1e-8 * expected.norm()) << k;
    };
    expect(terms[k].weights, adjoints[k].weights, [](MomentTerm& t, const Vector& v) { t.weights = v; });
    expect(terms[k].log_lengths, adjoints[k].log_lengths, [](MomentTerm& t, const Vector& v) { t.log_lengths = v; });
    expect(terms[k].centres.reshaped(), adjoints[k].centres.reshaped(),
           [](MomentTerm& t, const Vector& v) { t.centres = v.reshaped(t.size(), 5); });
  }
}

TEST(MomentMatching, OfACertainInputIsThePrediction) {
  const Reference reference;
  const gp::Posterior posterior = reference.posterior("perturbed");
  const Gaussian x{reference.X.row(3).transpose(), Matrix::Zero(6, 6)};
  const Transformed result = moments({exact_terms(posterior), 4}, x);
  Matrix mean(1, 4), variance(1, 4);
  posterior.predict(x.mean.transpose(), mean, variance);
  EXPECT_LT((result.mean - mean.transpose()).norm(), 1e-12);
  EXPECT_LT((result.covariance.diagonal() - variance.transpose()).norm(), 1e-12);
}

TEST(MomentMatching, IsTheSameForAnyNumberOfThreads) {
  const MomentMatching matching(mixture(6, 150), 2);
  const Gaussian x = tools::random_gaussian(6, 0.5, 51);
  const Transformed one = moments(matching, x);
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
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  MomentTape tape;
  Transformed result;
  for (const double bad : {nan, inf, -inf}) {
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
  const Transformed result = moments({terms, 2}, x);
  for (MomentTerm& term : terms) term.log_lengths(2) = 20;
  const Transformed nearly = moments({terms, 2}, x);
  EXPECT_LT((result.mean - nearly.mean).norm(), 1e-12);
  EXPECT_LT((result.covariance - nearly.covariance).norm(), 1e-12);
  for (MomentTerm& term : terms) term.log_lengths(2) = -400;  // no two points are alike
  EXPECT_LT(moments({terms, 2}, x).mean.norm(), 1e-90);
}

TEST(MomentMatching, RefusesWhatDoesNotFit) {
  std::vector<MomentTerm> terms = mixture(3);
  EXPECT_THROW(MomentMatching(terms, 1), InvalidInput);
  EXPECT_THROW(MomentMatching(terms, 2, true), InvalidInput) << "no adjoint of GPs";
  terms[0].weights(0) = std::nan("");
  EXPECT_THROW(MomentMatching(terms, 2), InvalidInput);
  EXPECT_THROW(MomentMatching({}, 2), InvalidInput);
}

}  // namespace
}  // namespace rehearse::moments
