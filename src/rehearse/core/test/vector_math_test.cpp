#include "rehearse/core/vector_math.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/random.hpp"

namespace rehearse {
namespace {

Vector uniforms(Index n, double low, double high) {
  Rng rng({.seed = 1});
  Vector x(n);
  for (double& value : x) value = rng.uniform(low, high);
  return x;
}

using Function = void (*)(const double*, double*, Index);

void expect_close(Function ours, double (*theirs)(double), const Vector& x, double relative, double absolute = 0) {
  Vector y(x.size());
  ours(x.data(), y.data(), x.size());
  for (Index i = 0; i < x.size(); ++i)
    ASSERT_NEAR(y(i), theirs(x(i)), relative * std::abs(theirs(x(i))) + absolute) << x(i);
}

double std_exp(double x) { return std::exp(x); }
double std_tanh(double x) { return std::tanh(x); }

TEST(VectorMath, ExpAgreesWithTheLibrary) {
  expect_close(vector_exp, std_exp, uniforms(10001, -700, 700), 1e-14);
  expect_close(vector_exp, std_exp, uniforms(10001, -1, 1), 1e-14);
  expect_close(vector_exp, std_exp, Vector{{0, -0.0, 1e-300}}, 0);
  const Vector large{{709.79, 800, 1419.5, 2000, 5000, 1e300}};
  Vector infinite(large.size());
  vector_exp(large.data(), infinite.data(), large.size());
  EXPECT_EQ(infinite, Vector::Constant(large.size(), kInf));
}

TEST(VectorMath, TanhAgreesWithTheLibrary) {
  expect_close(vector_tanh, std_tanh, uniforms(10001, -20, 20), 1e-14);
  expect_close(vector_tanh, std_tanh, uniforms(10001, -0.1, 0.1), 1e-14);
  expect_close(vector_tanh, std_tanh, Vector{{0, 1e-200, -1e-8}}, 1e-14);
}

TEST(VectorMath, SineAndCosineAgreeWithTheLibrary) {
  for (const double range : {1.0, 10.0, 1000.0, 38999.0, 1e6, 1e15, 1e300}) {
    const Vector x = uniforms(10001, -range, range);
    Vector sine(x.size()), cosine(x.size());
    vector_sin_cos(x.data(), sine.data(), cosine.data(), x.size());
    for (Index i = 0; i < x.size(); ++i) {
      ASSERT_NEAR(sine(i), std::sin(x(i)), 1e-14) << x(i);
      ASSERT_NEAR(cosine(i), std::cos(x(i)), 1e-14) << x(i);
    }
  }
}

TEST(VectorMath, AFarAngleDisturbsNoOther) {
  const Vector x = uniforms(41, -5, 5);
  for (const double far : {39000.0, -1e300, kInf, -kInf, kNaN}) {
    for (Index place = 0; place < 41; ++place) {
      Vector with = x, sine(41), cosine(41), other_sine(41), other_cosine(41);
      with(place) = far;
      vector_sin_cos(x.data(), sine.data(), cosine.data(), 41);
      vector_sin_cos(with.data(), other_sine.data(), other_cosine.data(), 41);
      for (Index i = 0; i < 41; ++i) {
        EXPECT_TRUE(i == place || (sine(i) == other_sine(i) && cosine(i) == other_cosine(i))) << far << " " << i;
        EXPECT_TRUE(i != place || std::isnan(other_sine(i)) != std::isfinite(far)) << far;
        EXPECT_TRUE(i != place || std::isnan(other_cosine(i)) != std::isfinite(far)) << far;
      }
    }
  }
}

TEST(VectorMath, NanIsKeptAndDisturbsNoOther) {
  for (Index n = 1; n <= 19; ++n) {
    for (Index bad = 0; bad < n; ++bad) {
      Vector x = uniforms(n, -1, 1);
      x(bad) = kNaN;
      Vector exponentials(n), tangents(n);
      vector_exp(x.data(), exponentials.data(), n);
      vector_tanh(x.data(), tangents.data(), n);
      for (Index i = 0; i < n; ++i) {
        EXPECT_EQ(std::isnan(exponentials(i)), i == bad);
        EXPECT_EQ(std::isnan(tangents(i)), i == bad);
      }
    }
  }
}

TEST(VectorMath, ExtremesAreLimits) {
  const Vector x{{-kInf, -1e300, -800, 1e300, kInf}};
  Vector y(5);
  vector_exp(x.data(), y.data(), 5);
  for (Index i = 0; i < 3; ++i) EXPECT_EQ(y(i), 0) << x(i);
  for (Index i = 3; i < 5; ++i) EXPECT_EQ(y(i), kInf) << x(i);
  vector_tanh(x.data(), y.data(), 5);
  for (Index i = 0; i < 5; ++i) EXPECT_EQ(y(i), i < 3 ? -1 : 1) << x(i);
}

TEST(VectorMath, AnEntryDoesNotDependOnItsPlace) {
  const Vector x = uniforms(41, -5, 5);
  for (const Function f : {Function(vector_exp), Function(vector_tanh)}) {
    Vector all(41);
    f(x.data(), all.data(), 41);
    for (Index i = 0; i < 41; ++i) {
      double one = 0;
      f(x.data() + i, &one, 1);
      EXPECT_EQ(one, all(i));
    }
  }
}

TEST(VectorMath, InPlace) {
  const Vector x = uniforms(21, -5, 5);
  Vector sine(21), cosine(21), in_sine = x, in_cosine = x, other(21);
  vector_sin_cos(x.data(), sine.data(), cosine.data(), 21);
  vector_sin_cos(in_sine.data(), in_sine.data(), other.data(), 21);
  EXPECT_EQ(in_sine, sine);
  EXPECT_EQ(other, cosine);
  vector_sin_cos(in_cosine.data(), other.data(), in_cosine.data(), 21);
  EXPECT_EQ(in_cosine, cosine);
  EXPECT_EQ(other, sine);
}

TEST(VectorMath, BoxMullerIsItsFormula) {
  const Vector u1 = uniforms(101, 0, 1), u2 = uniforms(101, 0, 1).reverse();
  Vector first(101), second(101), alone(101);
  box_muller(u1.data(), u2.data(), first.data(), second.data(), 101);
  box_muller(u1.data(), u2.data(), alone.data(), nullptr, 101);
  EXPECT_EQ(alone, first);
  for (Index i = 0; i < 101; ++i) {
    const double radius = std::sqrt(-2 * std::log(1 - u1(i)));
    EXPECT_NEAR(first(i), radius * std::cos(2 * M_PI * u2(i)), 1e-13);
    EXPECT_NEAR(second(i), radius * std::sin(2 * M_PI * u2(i)), 1e-13);
  }
}

}  // namespace
}  // namespace rehearse
