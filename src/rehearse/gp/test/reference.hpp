#pragma once
// Numbers computed by PILCO v0.9 (Deisenroth 2011) in GNU Octave: data/a_gp_nlml.json holds their definition.

#include <fstream>

#include <nlohmann/json.hpp>

#include "rehearse/core/types.hpp"

namespace rehearse::gp::reference {

inline nlohmann::json load() {
  std::ifstream file(TEST_DATA_DIR "/a_gp_nlml.json");
  return nlohmann::json::parse(file);
}

inline Matrix matrix(const nlohmann::json& rows) {
  Matrix m(static_cast<Index>(rows.size()), static_cast<Index>(rows[0].size()));
  for (Index i = 0; i < m.rows(); ++i)
    for (Index j = 0; j < m.cols(); ++j) m(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return m;
}

}  // namespace rehearse::gp::reference
