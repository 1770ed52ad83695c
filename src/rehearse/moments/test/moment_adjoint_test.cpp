// The adjoint of MomentMatching.

#include <gtest/gtest.h>

#include "matching_cases.hpp"

namespace rehearse::moments {
namespace {

using matching::mixture, matching::matched_moments;

TEST(MomentAdjoint, AgreesWithDifferencesForAnyNumberOfInputs) {
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
      tools::expect_slopes([&](const Gaussian& at) { return tools::inner(by, matched_moments(matching, at)); }, x,
                           adjoint);
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

TEST(MomentAdjoint, OfTheTermsAgreesWithDifferences) {
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
  tools::expect_slopes([&](const Gaussian& at) { return tools::inner(by, matched_moments(matching, at)); }, x, adjoint);
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const auto expect = [&](const Vector& start, const Vector& value, auto set) {
      const Vector expected = tools::slopes(
          [&](const Vector& at) {
            std::vector<MomentTerm> moved = terms;
            set(moved[k], at);
            return tools::inner(by, matched_moments({moved, 2}, x));
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

}  // namespace
}  // namespace rehearse::moments
