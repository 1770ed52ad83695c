#include "rehearse/optim/box.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/optim/median.hpp"

namespace rehearse::optim {
namespace {

constexpr std::size_t kEstimates = 5;  // generations from which the first weights are estimated

/// The interquartile range of the finite values.
double interquartile_range(const ConstVectorView& values) {
  std::vector<double> sorted;
  for (const double value : values)
    if (std::isfinite(value)) sorted.push_back(value);
  if (sorted.empty()) return 0;
  std::sort(sorted.begin(), sorted.end());
  return sorted[3 * sorted.size() / 4] - sorted[sorted.size() / 4];
}

}  // namespace

double Box::outside(double x, Index i) const { return x - std::clamp(x, at(i).low, at(i).high); }

void Box::project(MatrixView X) const {
  for (Index i = 0; bounded() && i < X.rows(); ++i) X.row(i) = X.row(i).cwiseMax(at(i).low).cwiseMin(at(i).high);
}

const Vector& Box::penalties(const ConstMatrixView& X, const ConstVectorView& values, const ConstVectorView& mean,
                             const ConstVectorView& deviations, double mu_eff) {
  penalties_ = Vector::Zero(values.size());
  if (!bounded()) return penalties_;
  if (weights_.size() == 0) weights_ = Vector::Zero(mean.size());
  estimate(values, deviations.squaredNorm() / static_cast<double>(mean.size()));
  strengthen(mean, deviations, mu_eff);
  const double mean_log = deviations.array().log().mean();
  for (Index i = 0; i < X.rows(); ++i) {
    // A long axis is punished less; not in full, or the first weights would have to be right for every axis.
    const double relative = std::exp(1.8 * (std::log(deviations(i)) - mean_log));
    for (Index j = 0; j < X.cols(); ++j)
      if (const double d = outside(X(i, j), i); d != 0)
        penalties_(j) += weights_(i) * d * d / (relative * static_cast<double>(mean.size()));
  }
  return penalties_;
}

/// The first weights: leaving by σ costs some interquartile ranges of the values. On a plateau they are not estimated.
void Box::estimate(const ConstVectorView& values, double variance) {
  if (curvatures_.size() >= kEstimates) return;
  const double range = interquartile_range(values);
  if (!(range > 0)) return;
  curvatures_.push_back(range / variance);
  weights_.setConstant(10 * upper_median(curvatures_));
}

/// A mean far outside shows that its weight is too small, for instance since values grew after a plateau.
void Box::strengthen(const ConstVectorView& mean, const ConstVectorView& deviations, double mu_eff) {
  const double far = 3 * std::max(1.0, std::sqrt(static_cast<double>(mean.size())) / mu_eff);
  for (Index i = 0; i < mean.size(); ++i)
    if (std::abs(outside(mean(i), i)) > far * deviations(i)) weights_(i) *= 1.1;
}

std::vector<std::string> box_violations(const std::vector<Interval>& box, Index n) {
  std::vector<std::string> lines;
  if (!box.empty() && static_cast<Index>(box.size()) != n)
    lines.push_back(fmt::format("box has {} intervals, must have {}", box.size(), n));
  for (std::size_t i = 0; i < box.size(); ++i)
    if (!(box[i].low < box[i].high) || !std::isfinite(box[i].low) || !std::isfinite(box[i].high))
      lines.push_back(fmt::format("box[{}] = [{}, {}], must be finite and not empty", i, to_text(box[i].low),
                                  to_text(box[i].high)));
  return lines;
}

std::vector<std::string> start_violations(const Vector& start, const std::vector<Interval>& box) {
  std::vector<std::string> lines;
  if (start.size() == 0) lines.push_back("start has no coordinates, must have at least 1");
  for (Index i = 0; i < start.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!std::isfinite(start(i)))
      lines.push_back(fmt::format("start[{}] = {}, must be finite", i, to_text(start(i))));
    else if (k < box.size() && (start(i) < box[k].low || start(i) > box[k].high))
      lines.push_back(fmt::format("start[{}] = {}, must be between {} and {}", i, to_text(start(i)),
                                  to_text(box[k].low), to_text(box[k].high)));
  }
  return lines;
}

void require_searchable(const Vector& start, const std::vector<Interval>& box,
                        const std::vector<std::string>& of_options) {
  Violations violations;
  violations.add(of_options);
  violations.require(!box.empty(), "box is empty, must have an interval for each coordinate");
  violations.add(box_violations(box, start.size()));
  violations.add(start_violations(start, box));
  violations.throw_if_any();
}

Vector uniform_point(const std::vector<Interval>& box, double part, const StreamKey& key) {
  Rng rng(key);
  Vector x(static_cast<Index>(box.size()));
  for (Index i = 0; i < x.size(); ++i) {
    const auto [low, high] = box[static_cast<std::size_t>(i)];
    const double middle = (low + high) / 2, half = part * (high - low) / 2;
    x(i) = rng.uniform(middle - half, middle + half);
  }
  return x;
}

}  // namespace rehearse::optim
