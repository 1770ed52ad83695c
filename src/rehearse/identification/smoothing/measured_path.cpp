#include "rehearse/identification/smoothing/measured_path.hpp"

namespace rehearse::identification {
namespace {

constexpr double kRoundingOfStates = 1e-9;

bool continues(const Dataset& data, Index row) {
  const Eigen::RowVectorXd start = data.states.row(row);
  const Eigen::RowVectorXd end = data.states.row(row - 1) + data.changes.row(row - 1);
  return ((end - start).array().abs() <= kRoundingOfStates * (1 + start.array().abs())).all();
}

/// Calls visit(row, measurement before it) for each row.
template <class Visit>
void for_each_row(const std::vector<Block>& blocks, Visit visit) {
  for (const Block& block : blocks)
    for (Index i = 0; i < block.rows; ++i)
      visit(block.first + i, block.first_measurement + block.before[static_cast<std::size_t>(i)]);
}

}  // namespace

std::vector<Block> blocks_of(const Dataset& data, Index most, Measurements measurements) {
  const bool shared = measurements == Measurements::shared;
  std::vector<Block> blocks;
  Index count = 0;
  for (Index row = 0; row < data.size(); ++row) {
    const bool full = blocks.empty() || blocks.back().rows == most;
    if (full) blocks.push_back({.first = row, .first_measurement = count});
    Block& block = blocks.back();
    const Index before = shared && !full && continues(data, row) ? count - 1 : count;
    count = before + 2;
    block.before.push_back(before - block.first_measurement);
    block.measurements = count - block.first_measurement;
    ++block.rows;
  }
  return blocks;
}

Matrix measurements_of(const Dataset& data, const std::vector<Block>& blocks) {
  if (blocks.empty()) return Matrix(0, data.states.cols());
  Matrix Y(blocks.back().first_measurement + blocks.back().measurements, data.states.cols());
  for_each_row(blocks, [&](Index row, Index before) {
    Y.row(before) = data.states.row(row);
    Y.row(before + 1) = data.states.row(row) + data.changes.row(row);
  });
  return Y;
}

Dataset path_of(const Matrix& X, const Dataset& data, const std::vector<Block>& blocks) {
  Dataset path = data;
  for_each_row(blocks, [&](Index row, Index before) {
    path.states.row(row) = X.row(before);
    path.changes.row(row) = X.row(before + 1) - X.row(before);
  });
  return path;
}

}  // namespace rehearse::identification
