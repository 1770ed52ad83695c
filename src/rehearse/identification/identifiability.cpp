#include "rehearse/identification/identifiability.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/identification/combinations.hpp"

namespace rehearse::identification {
namespace {

constexpr double kUnsure = 0.1;       // half an interval that is worth a sentence, as a fraction of the box
constexpr double kAnything = 0.5;     // a whole interval that says next to nothing, likewise
constexpr double kOthersKnown = 0.3;  // parameters cannot be separated if less than this fraction of a deviation is
                                      // left once the others are known; for two of them: a correlation of 0.95
constexpr double kLinked = 0.5;       // correlation of those that are named together
constexpr double kRounding = 1e-9;    // of a variance: combinations that are known better are all known
constexpr double kAtEnd = 1e-3;       // of the box

double width(const Interval& box) { return box.high - box.low; }

/// "a", "a and b", "a, b and c".
std::string list(const std::vector<std::string>& names) {
  if (names.size() == 1) return names.front();
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

Matrix correlations(const Matrix& covariance) {
  const Vector inverse = covariance.diagonal().cwiseSqrt().cwiseInverse();
  return inverse.asDiagonal() * covariance * inverse.asDiagonal();
}

/// These parameters in groups: those that the data cannot tell apart together, each of the others alone.
std::vector<std::vector<Index>> groups_of(std::vector<Index> parameters, const Matrix& covariance) {
  const Index q = covariance.rows();
  const Matrix together = correlations(covariance) + kRounding * Matrix::Identity(q, q);
  const Matrix precision = together.llt().solve(Matrix::Identity(q, q));
  const Matrix links = together.cwiseAbs().cwiseMax(correlations(precision).cwiseAbs());
  const auto needs_others = [&](Index i) {
    return 1 / (together(i, i) * precision(i, i)) < kOthersKnown * kOthersKnown;
  };
  std::vector<std::vector<Index>> groups;
  while (!parameters.empty()) {
    std::vector<Index> group{parameters.front()};
    parameters.erase(parameters.begin());
    for (std::size_t i = 0; i < group.size(); ++i) {
      const auto apart = [&, from = group[i]](Index to) {
        return !needs_others(from) || !needs_others(to) || links(from, to) < kLinked;
      };
      const auto linked = std::stable_partition(parameters.begin(), parameters.end(), apart);
      group.insert(group.end(), linked, parameters.end());
      parameters.erase(linked, parameters.end());
    }
    std::sort(group.begin(), group.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

class Warnings {
 public:
  explicit Warnings(const PhiPosterior& posterior) : posterior_(posterior), intervals_(posterior.intervals()) {}

  std::vector<std::string> sentences() const {
    std::vector<Index> unsure;
    for (Index i = 0; i < posterior_.mean.size(); ++i)
      if (is_unsure(i)) unsure.push_back(i);
    std::vector<std::string> all;
    for (const std::vector<Index>& group : groups_of(unsure, posterior_.covariance)) all.push_back(sentence(group));
    for (Index i = 0; i < posterior_.mean.size(); ++i)
      if (const auto end = end_at(of(i), posterior_.mean(i)); end && reaches(i, *end))
        all.push_back(fmt::format("{} is at its bound, {:.3g}: a better value may lie beyond", of(i).name, *end));
    return all;
  }

 private:
  /// True unless the interval says that the value is beside the end of the box.
  bool reaches(Index i, double end) const {
    const Interval& interval = intervals_[static_cast<std::size_t>(i)];
    return !(interval.low > end || interval.high < end);
  }
  const Parameter& of(Index i) const { return posterior_.parameters[static_cast<std::size_t>(i)]; }

  /// True if a parameter's interval is wide. Half of it is at least 1.96 deviations, even where the box cuts it.
  bool is_unsure(Index i) const {
    const double deviation = std::sqrt(posterior_.covariance(i, i));
    const double half = std::max(kNormal * deviation, width(intervals_[static_cast<std::size_t>(i)]) / 2);
    return half > kUnsure * width(of(i).box);
  }

  /// About parameters that the data cannot tell apart, or one that could be anything in a range.
  std::string sentence(const std::vector<Index>& group) const {
    std::vector<std::string> names;
    for (const Index i : group) names.push_back(of(i).name);
    if (names.size() == 1) {
      const Interval range = intervals_[static_cast<std::size_t>(group.front())];
      const bool anything = width(range) > kAnything * width(of(group.front()).box);
      return fmt::format("{} is {} these data: {:.3g} to {:.3g}", names.front(),
                         anything ? "not determined by" : "known only roughly from", range.low, range.high);
    }
    const std::string apart = fmt::format("{} cannot be told apart by these data", list(names));
    if (posterior_.alternatives.size() == 0) return apart;
    const auto known =
        known_combinations(names, posterior_.alternatives(group, Eigen::all), posterior_.unknown_directions);
    if (known.empty()) return apart;
    return fmt::format("{}; known {} {}", apart, known.size() == 1 ? "is" : "are", list(known));
  }

  const PhiPosterior& posterior_;
  const std::vector<Interval> intervals_;
};

}  // namespace

std::optional<double> end_at(const Parameter& parameter, double value) {
  for (const double end : {parameter.box.low, parameter.box.high})
    if (std::abs(value - end) <= kAtEnd * width(parameter.box)) return end;
  return {};
}

std::vector<std::string> identifiability_warnings(const PhiPosterior& posterior) {
  return Warnings(posterior).sentences();
}

}  // namespace rehearse::identification
