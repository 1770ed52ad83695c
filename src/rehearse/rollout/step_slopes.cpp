#include "rehearse/rollout/step_slopes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rehearse::rollout {
namespace {

/// The width of a difference with respect to a number that is v: with it rounding is 1e-11 of a reward.
double width_of(double v) { return 1e-5 * std::max(1.0, std::abs(v)); }

using Parts = std::array<const ConstMatrixView*, 4>;
constexpr std::size_t kReached = 2;  // the part that rewards depend on

/// Copies of all rows, one block after the other, with what they earn; numbers of a block may be shifted.
struct Blocks {
  std::array<Matrix, 4> parts;  // X, U, X_next, U_before
  Vector earned, cost;
  Index n = 0;

  void copy(const Parts& from, Index blocks) {
    n = from.front()->rows();
    earned.resize(blocks * n);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      parts[p].resize(blocks * n, from[p]->cols());
      for (Index b = 0; b < blocks && from[p]->rows() == n; ++b) parts[p].middleRows(b * n, n) = *from[p];
    }
  }

  void shift(Index block, std::size_t part, Index column, double widths) {
    auto numbers = parts[part].col(column).segment(block * n, n);
    numbers += widths * numbers.unaryExpr(&width_of);
  }

  void earn(const Task& task, double time_s) {
    const auto& [X, U, X_next, U_before] = parts;
    task.reward(X, U, X_next, earned);
    if (!task.cost) return;
    cost.resize(earned.size());
    task.cost({X, U, X_next, U_before, time_s}, cost);
    earned -= cost;
  }

  auto of(Index block) const { return earned.segment(block * n, n); }
};

/// Two blocks from `block` on for each number of a part: a little less of it, a little more.
Index surround(std::size_t part, Index block, Blocks& blocks) {
  for (Index c = 0; c < blocks.parts[part].cols(); ++c, block += 2) {
    blocks.shift(block, part, c, -1);
    blocks.shift(block + 1, part, c, 1);
  }
  return block;
}

void write_slopes(const ConstMatrixView& at, const Blocks& blocks, Index block, Eigen::Ref<Matrix> by) {
  for (Index c = 0; c < at.cols(); ++c, block += 2)
    by.col(c) = (blocks.of(block + 1) - blocks.of(block)).array() / (2 * at.col(c).unaryExpr(&width_of)).array();
}

/// True if two blocks earn the same to the bit.
bool same(const Blocks& blocks, Index a, Index b) {
  for (Index i = 0; i < blocks.n; ++i) {
    const double one = blocks.of(a)(i), other = blocks.of(b)(i);
    if (one != other && !(std::isnan(one) && std::isnan(other))) return false;
  }
  return true;
}

}  // namespace

void step_slopes(const Task& task, const Steps& steps, Matrix& by) {
  thread_local Blocks blocks;
  const Parts parts = {&steps.X, &steps.U, &steps.X_next, &steps.U_before};
  const std::array<Index, 4> columns = {steps.X.cols(), steps.U.cols(), steps.X_next.cols(),
                                        task.cost ? steps.U.cols() : 0};
  std::array<Index, 5> first = {};  // column of each part in `by`
  for (std::size_t p = 0; p < parts.size(); ++p) first[p + 1] = first[p] + columns[p];
  by.setZero(steps.X.rows(), first.back());
  // Block 0 is the rows as they are, block 1 with a little more of everything but the states reached: of each number
  // another little, because a reward may know differences of two alone.
  blocks.copy(parts, 2 + 2 * columns[kReached]);
  double widths = 1;
  for (const std::size_t p : {0, 1, 3})
    for (Index c = 0; c < columns[p]; ++c, widths += 0.37) blocks.shift(1, p, c, widths);
  surround(kReached, 2, blocks);
  blocks.earn(task, steps.time_s);
  write_slopes(steps.X_next, blocks, 2, by.middleCols(first[kReached], columns[kReached]));
  if (same(blocks, 0, 1)) return;
  blocks.copy(parts, 2 * (first.back() - columns[kReached]));
  Index block = 0;
  for (const std::size_t p : {0, 1, 3})
    if (columns[p] > 0) block = surround(p, block, blocks);
  blocks.earn(task, steps.time_s);
  block = 0;
  for (const std::size_t p : {0, 1, 3}) {
    if (columns[p] > 0) write_slopes(*parts[p], blocks, block, by.middleCols(first[p], columns[p]));
    block += 2 * columns[p];
  }
}

}  // namespace rehearse::rollout
