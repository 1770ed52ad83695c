#pragma once

#include "rehearse/qd/archive.hpp"

namespace rehearse::qd {

/// An empty one over the square of [−1, 1].
inline Archive square_archive(Index bins = 10, Index parameters = 5) {
  return {Niches(Grid{{{-1, 1}, {-1, 1}}, {bins, bins}}), parameters};
}

}  // namespace rehearse::qd
