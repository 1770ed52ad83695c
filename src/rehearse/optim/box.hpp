#pragma once
// Search whose candidates must stay in a box.

#include <string>
#include <vector>

#include "rehearse/core/random.hpp"
#include "rehearse/core/types.hpp"

namespace rehearse::optim {

/// Draws leave the box: the candidates are their projections onto it, and what they lose by leaving grows with the
/// square of the distance. The weights of this penalty adapt (Hansen 2009, A method for handling uncertainty in
/// evolutionary optimization, appendix). A smooth periodic map onto the box was tried instead: it needed six times the
/// evaluations on BBOB's f15, because its mirror images are optima too.
class Box {
 public:
  Box() = default;  // unbounded
  explicit Box(std::vector<Interval> intervals) : intervals_(std::move(intervals)) {}

  bool bounded() const { return !intervals_.empty(); }
  double width(Index i) const { return at(i).high - at(i).low; }

  /// Projects each column of X (dimension × count).
  void project(MatrixView X) const;

  /// The penalties (λ), to be subtracted from the values (λ) of the projections of the draws X (n × λ). `mean`,
  /// `deviations` (n) and `mu_eff` are those of the search distribution of the draws. To be called once a generation.
  const Vector& penalties(const ConstMatrixView& X, const ConstVectorView& values, const ConstVectorView& mean,
                          const ConstVectorView& deviations, double mu_eff);

 private:
  const Interval& at(Index i) const { return intervals_[static_cast<std::size_t>(i)]; }
  double outside(double x, Index i) const;
  void estimate(const ConstVectorView& values, double variance);
  void strengthen(const ConstVectorView& mean, const ConstVectorView& deviations, double mu_eff);

  std::vector<Interval> intervals_;
  Vector weights_;                  // n
  std::vector<double> curvatures_;  // seen in the first generations
  Vector penalties_;
};

/// A line for everything that makes `box` unfit for points of n coordinates; an empty box is fit.
std::vector<std::string> box_violations(const std::vector<Interval>& box, Index n);

/// A line for everything that makes `start` unfit: empty, not finite, outside the box (if there is one).
std::vector<std::string> start_violations(const Vector& start, const std::vector<Interval>& box);

/// Throws InvalidInput, with these lines and those of options (field_violations), unless `box` is there and one to
/// search in from `start`.
void require_searchable(const Vector& start, const std::vector<Interval>& box,
                        const std::vector<std::string>& of_options);

/// A random point (n) for a search to begin at: uniform in the middle `part` of each side of the box (0 to 1).
Vector uniform_point(const std::vector<Interval>& box, double part, const StreamKey& key);

}  // namespace rehearse::optim
