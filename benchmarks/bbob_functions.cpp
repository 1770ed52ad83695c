#include "bbob_functions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace bbob {
namespace {

/// The uniform numbers of the official instances: Park and Miller's generator, shuffled as Bays and Durham do.
Vector official_uniform(Index n, double seed) {
  double state = std::max(std::abs(seed), 1.0);
  const auto next = [&state] {
    const double quotient = std::floor(state / 127773);
    state = 16807 * (state - quotient * 127773) - 2836 * quotient;
    return state = state < 0 ? state + 2147483647 : state;
  };
  double shuffled[32];
  for (int i = 39; i >= 0; --i) {
    const double value = next();
    if (i < 32) shuffled[i] = value;
  }
  double last = shuffled[0];
  Vector numbers(n);
  for (double& number : numbers) {
    const double fresh = next();
    double& slot = shuffled[static_cast<int>(std::floor(last / 67108865))];
    last = slot;
    slot = fresh;
    number = std::max(last / 2147483647, 1e-99);
  }
  return numbers;
}

Vector official_normal(Index n, double seed) {
  const Vector u = official_uniform(2 * n, seed);
  Vector g(n);
  for (Index i = 0; i < n; ++i) {
    g(i) = std::sqrt(-2 * std::log(u(i))) * std::cos(2 * std::numbers::pi * u(n + i));
    if (g(i) == 0) g(i) = 1e-99;
  }
  return g;
}

/// Rows orthonormalised one after the other.
Matrix official_rotation(Index n, double seed) {
  Matrix B = official_normal(n * n, seed).reshaped(n, n).transpose();
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < i; ++j) B.row(i) -= B.row(i).dot(B.row(j)) * B.row(j);
    B.row(i).normalize();
  }
  return B;
}

Vector official_optimum(Index n, double seed) {
  Vector x = 8 * (1e4 * official_uniform(n, seed).array()).floor() / 1e4 - 4;
  for (double& xi : x)
    if (xi == 0) xi = -1e-5;
  return x;
}

double official_offset(double seed) {
  const double ratio = official_normal(1, seed)(0) / official_normal(1, seed + 1)(0);
  return std::clamp(std::round(1e4 * ratio) / 100, -1000.0, 1000.0);
}

/// i / (n − 1), the exponent of a conditioning.
double position(Index i, Index n) { return static_cast<double>(i) / static_cast<double>(n - 1); }

double oscillate(double x) {  // T_osz
  if (x == 0) return 0;
  const double h = std::log(std::abs(x)), c1 = x > 0 ? 10 : 5.5, c2 = x > 0 ? 7.9 : 3.1;
  return std::copysign(std::exp(h + 0.049 * (std::sin(c1 * h) + std::sin(c2 * h))), x);
}

void oscillate(Vector& x) {
  for (double& xi : x) xi = oscillate(xi);
}

void make_asymmetric(Vector& x, double beta) {  // T_asy
  for (Index i = 0; i < x.size(); ++i)
    if (x(i) > 0) x(i) = std::pow(x(i), 1 + beta * position(i, x.size()) * std::sqrt(x(i)));
}

double rastrigin(const Vector& z) {
  return 10 * (static_cast<double>(z.size()) - (2 * std::numbers::pi * z.array()).cos().sum()) + z.squaredNorm();
}

double rosenbrock(const Vector& z) {
  const Index n = z.size() - 1;
  return 100 * (z.head(n).array().square() - z.tail(n).array()).square().sum() + (z.head(n).array() - 1).square().sum();
}

double schaffers(const Vector& z) {
  double sum = 0;
  for (Index i = 0; i + 1 < z.size(); ++i) {
    const double s = std::hypot(z(i), z(i + 1)), wave = std::sin(50 * std::pow(s, 0.2));
    sum += std::sqrt(s) * (1 + wave * wave);
  }
  return std::pow(sum / static_cast<double>(z.size() - 1), 2);
}

struct Entry {
  Kind kind;
  int seed;  // of the instance
  Noise noise;
  double strength;
  const char* name;
};

const std::map<int, Entry> entries{
    {1, {Kind::sphere, 1, Noise::none, 0, "sphere"}},
    {2, {Kind::ellipsoid, 2, Noise::none, 0, "ellipsoid"}},
    {3, {Kind::rastrigin, 3, Noise::none, 0, "Rastrigin"}},
    {8, {Kind::rosenbrock, 8, Noise::none, 0, "Rosenbrock"}},
    {10, {Kind::rotated_ellipsoid, 10, Noise::none, 0, "ellipsoid, rotated"}},
    {15, {Kind::rotated_rastrigin, 15, Noise::none, 0, "Rastrigin, rotated"}},
    {17, {Kind::schaffers, 17, Noise::none, 0, "Schaffers F7"}},
    {101, {Kind::sphere, 1, Noise::gauss, 0.01, "sphere, moderate Gaussian noise"}},
    {102, {Kind::sphere, 1, Noise::uniform, 0.01, "sphere, moderate uniform noise"}},
    {104, {Kind::rosenbrock, 8, Noise::gauss, 0.01, "Rosenbrock, moderate Gaussian noise"}},
    {105, {Kind::rosenbrock, 8, Noise::uniform, 0.01, "Rosenbrock, moderate uniform noise"}},
    {107, {Kind::sphere, 1, Noise::gauss, 1, "sphere, Gaussian noise"}},
    {108, {Kind::sphere, 1, Noise::uniform, 1, "sphere, uniform noise"}},
    {110, {Kind::rosenbrock, 8, Noise::gauss, 1, "Rosenbrock, Gaussian noise"}},
    {111, {Kind::rosenbrock, 8, Noise::uniform, 1, "Rosenbrock, uniform noise"}},
};

}  // namespace

std::string name_of(int number) { return entries.at(number).name; }

Function::Function(int number, Index n, int instance) {
  const Entry& entry = entries.at(number);
  const double seed = entry.seed + 1e4 * instance;
  kind_ = entry.kind;
  noise_ = entry.noise;
  strength_ = entry.strength;
  optimum_ = official_optimum(n, seed);
  if (kind_ == Kind::rosenbrock) optimum_ *= 0.75;
  official_minimum_ = official_offset(seed);
  const bool ellipsoidal = kind_ == Kind::ellipsoid || kind_ == Kind::rotated_ellipsoid;
  conditioning_ =
      Vector::NullaryExpr(n, [&](Index i) { return std::pow(ellipsoidal ? 1e6 : std::sqrt(10.0), position(i, n)); });
  // x as a row times the official matrices: their transposes here.
  R_ = official_rotation(n, seed + 1e6).transpose();
  Q_ = official_rotation(n, seed).transpose();
}

double Function::operator()(const Vector& x) const {
  Vector z = x - optimum_;
  const double n = static_cast<double>(x.size());
  switch (kind_) {
    case Kind::sphere:
      return z.squaredNorm();
    case Kind::rosenbrock:
      return rosenbrock((std::max(1.0, std::sqrt(n) / 8) * z).array() + 1);
    case Kind::rotated_ellipsoid:
      z = R_ * z;
      [[fallthrough]];
    case Kind::ellipsoid:
      oscillate(z);
      return conditioning_.dot(z.cwiseAbs2());
    case Kind::rastrigin:
      oscillate(z);
      make_asymmetric(z, 0.2);
      return rastrigin(conditioning_.cwiseProduct(z));
    case Kind::rotated_rastrigin:
      z = R_ * z;
      oscillate(z);
      make_asymmetric(z, 0.2);
      return rastrigin(R_ * conditioning_.cwiseProduct(Q_ * z));
    case Kind::schaffers:
      z = R_ * z;
      make_asymmetric(z, 0.5);
      return schaffers(conditioning_.cwiseProduct(Q_ * z));
  }
  throw std::logic_error("no such function");
}

double Function::noisy(double value, rehearse::Rng& rng) const {
  constexpr double target = 1e-8;
  if (noise_ == Noise::none || value < target) return value;
  if (noise_ == Noise::gauss) return value * std::exp(strength_ * rng.normal()) + 1.01 * target;
  const double alpha = strength_ * (0.49 + 1 / static_cast<double>(optimum_.size()));
  const double shrunk = std::pow(rng.uniform(), strength_) * value;
  return shrunk * std::max(1.0, std::pow(1e9 / (value + 1e-99), alpha * rng.uniform())) + 1.01 * target;
}

std::string self_check() {
  const std::map<int, double> published{{1, -77.2745459},   {2, 6180022.8217},  {3, 92.987750752},  {8, 33355.792472},
                                        {10, 4374717.4934}, {15, 27.363312851}, {17, -24.330591878}};
  std::string wrong;
  for (const auto& [number, expected] : published) {
    const Function f(number, 4, 0);
    const double value = f(Vector::Zero(4)) + f.official_minimum();
    if (std::abs(value - expected) > 1e-9 * std::abs(expected) + 1e-7)
      wrong += fmt::format("f{} is {:.10g}, must be {:.10g}\n", number, value, expected);
  }
  return wrong;
}

}  // namespace bbob
