#include "rehearse/optim/box_transform.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/options.hpp"

namespace rehearse::optim {
namespace {

double margin(double bound, const Interval& box) {
  return std::min((box.high - box.low) / 2, (1 + std::abs(bound)) / 20);
}

/// One coordinate: its box with the margins below and above.
struct Side {
  double low, high, below, above;
  explicit Side(const Interval& b) : low(b.low), high(b.high), below(margin(b.low, b)), above(margin(b.high, b)) {}

  double first() const { return low - below; }
  double period() const { return 2 * (high + above - first()); }

  double fold(double x) const {
    if (x >= first() && x <= high + above) return x;
    double t = std::fmod(x - first(), period());
    if (t < 0) t += period();
    return first() + std::min(t, period() - t);
  }

  double into(double x) const {
    x = fold(x);
    if (x < low + below)
      x = low + (x - first()) * (x - first()) / (4 * below);
    else if (x > high - above)
      x = high - (x - high - above) * (x - high - above) / (4 * above);
    return std::clamp(x, low, high);
  }

  double out_of(double y) const {
    if (y < low + below) return first() + 2 * std::sqrt(below * (y - low));
    if (y > high - above) return high + above - 2 * std::sqrt(above * (high - y));
    return y;
  }

  double shifted_near(double x, double near) const { return x + period() * std::round((near - x) / period()); }

  double preimage(double y, double near) const {
    const double x = shifted_near(out_of(y), near);
    const double mirrored = shifted_near(2 * first() - out_of(y), near);
    return std::abs(mirrored - near) < std::abs(x - near) ? mirrored : x;
  }
};

}  // namespace

BoxTransform::BoxTransform(std::vector<Interval> box) : box_(std::move(box)) {}

void BoxTransform::into(MatrixView X) const {
  for (std::size_t i = 0; i < box_.size(); ++i) {
    const Side side(box_[i]);
    for (Index j = 0; j < X.cols(); ++j) {
      double& x = X(static_cast<Index>(i), j);
      x = side.into(x);
    }
  }
}

Vector BoxTransform::preimage(const ConstVectorView& x, const ConstVectorView& near) const {
  Vector out = x;
  for (std::size_t i = 0; i < box_.size(); ++i) {
    const Index k = static_cast<Index>(i);
    out(k) = Side(box_[i]).preimage(std::clamp(x(k), box_[i].low, box_[i].high), near(k));
  }
  return out;
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

}  // namespace rehearse::optim
