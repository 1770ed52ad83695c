#include "rehearse/identification/combinations.hpp"

#include <cmath>
#include <optional>

#include <Eigen/QR>
#include <fmt/format.h>

namespace rehearse::identification {
namespace {

constexpr double kSameSum = 0.01;  // of a parameter's deviation over the points: as much may a combination vary
constexpr double kLittle = 0.02;   // of it: a term that varies less is left out, a factor that is nearer to 1 is 1

double deviation(const Vector& values) { return std::sqrt((values.array() - values.mean()).square().mean()); }

/// values ≈ offset + factorsᵀ others, row by row of the points.
struct Expressed {
  double misfit;  // as a fraction of the deviation of the values
  Vector factors;
};

Expressed fit(const Matrix& others, const Vector& values) {
  const Matrix centred = (others.colwise() - others.rowwise().mean()).transpose();
  const Vector changes = values.array() - values.mean();
  const Vector factors = centred.colPivHouseholderQr().solve(changes);
  return {deviation(changes - centred * factors) / deviation(values), factors};
}

/// The factor, or power, as it is printed: of two digits, and 1 where it is hardly another.
double printed(double value) {
  if (std::abs(std::abs(value) - 1) < kLittle) return std::copysign(1, value);
  if (value == 0) return 0;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 1);
  return std::round(value / unit) * unit;
}

std::string number(double value) { return value == 1 ? "" : fmt::format("{:.2g}·", value); }

/// x + 2·y − z.
std::string sum(const std::string& name, const std::vector<std::string>& others, const Vector& factors) {
  std::string text = name;
  for (std::size_t k = 0; k < others.size(); ++k) {
    const double factor = -factors(static_cast<Index>(k));
    if (factor != 0) text += fmt::format(" {} {}{}", factor < 0 ? "−" : "+", number(std::abs(factor)), others[k]);
  }
  return text;
}

/// x·y^2/z.
std::string product(const std::string& name, const std::vector<std::string>& others, const Vector& powers) {
  std::string text = name;
  for (std::size_t k = 0; k < others.size(); ++k) {
    const double power = -powers(static_cast<Index>(k)), size = std::abs(power);
    if (power == 0) continue;
    text += (power < 0 ? "/" : "·") + others[k];
    if (size != 1) text += fmt::format("^{:.2g}", size);
  }
  return text;
}

/// The combination of a parameter with others that is the same at all points, if there is a simple one.
std::optional<std::string> combination(const std::string& name, const Vector& values,
                                       const std::vector<std::string>& others, const Matrix& other_values) {
  const bool positive = values.minCoeff() > 0 && other_values.minCoeff() > 0;
  Expressed linear = fit(other_values, values);
  Expressed logarithmic = positive ? fit(other_values.array().log(), values.array().log()) : Expressed{1, {}};
  const bool as_sum = linear.misfit <= logarithmic.misfit;
  Expressed& best = as_sum ? linear : logarithmic;
  if (!(best.misfit <= kSameSum)) return {};
  const auto scaled = [&](const Vector& of) { return as_sum ? of : Vector(of.array().log()); };
  double known = as_sum ? values.mean() : values.array().log().mean();
  for (Index k = 0; k < best.factors.size(); ++k) {
    const Vector other = scaled(other_values.row(k).transpose());
    if (std::abs(best.factors(k)) * deviation(other) < kLittle * deviation(scaled(values))) best.factors(k) = 0;
    best.factors(k) = printed(best.factors(k));
    known -= best.factors(k) * other.mean();
  }
  if (as_sum) return fmt::format("{} = {:.3g}", sum(name, others, best.factors), known);
  return fmt::format("{} = {:.3g}", product(name, others, best.factors), std::exp(known));
}

/// Combinations of other parameters with those that `bits` chooses, of as many as have one.
std::vector<std::string> combinations_with(unsigned bits, const std::vector<std::string>& names, const Matrix& points) {
  std::vector<std::string> others;
  std::vector<Index> rows;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (bits >> i & 1U) others.push_back(names[i]), rows.push_back(static_cast<Index>(i));
  std::vector<std::string> all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (bits >> i & 1U) continue;
    const auto one =
        combination(names[i], points.row(static_cast<Index>(i)).transpose(), others, points(rows, Eigen::all));
    if (one) all.push_back(*one);
  }
  return all;
}

}  // namespace

std::vector<std::string> known_combinations(const std::vector<std::string>& names, const Matrix& points,
                                            Index unknown) {
  const std::size_t q = names.size();
  if (q > 10 || points.cols() < 3 * static_cast<Index>(q)) return {};
  std::vector<std::string> most;
  for (Index pivots = 1; pivots <= unknown && pivots < static_cast<Index>(q); ++pivots)
    for (unsigned bits = 1; bits < 1U << q; ++bits) {
      if (__builtin_popcount(bits) != pivots) continue;
      auto all = combinations_with(bits, names, points);
      if (all.size() > most.size()) most = std::move(all);
      if (most.size() + static_cast<std::size_t>(pivots) == q) return most;
    }
  return most;
}

}  // namespace rehearse::identification
