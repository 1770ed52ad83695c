#pragma once

#include <vector>

#include "rehearse/core/episode.hpp"

namespace rehearse::identification {

/// Consecutive rows of a data set with the measured states that they start from and end in. Steps of one episode share
/// measurements, inside a block.
struct Block {
  Index first = 0, rows = 0;
  Index first_measurement = 0, measurements = 0;
  std::vector<Index> before;  // of each row, the measurement of the block that it starts from; it ends in the next one
};

/// The measurement between two steps of an episode: shared by them, or one of its own for each.
enum class Measurements { shared, own };

/// At most `most` rows each. Rows are steps of one episode where one starts in the state in which the last one ended.
std::vector<Block> blocks_of(const Dataset& data, Index most, Measurements measurements = Measurements::shared);

/// All measurements, block by block (any × dx).
Matrix measurements_of(const Dataset& data, const std::vector<Block>& blocks);

/// The same steps between the states X in place of the measurements.
Dataset path_of(const Matrix& X, const Dataset& data, const std::vector<Block>& blocks);

}  // namespace rehearse::identification
