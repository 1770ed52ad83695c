#pragma once
// Numbers computed by PILCO v0.9 (Deisenroth 2011) in GNU Octave: each file of test/data holds their definition. A test
// that includes this links nlohmann_json.

#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

#include "rehearse/core/types.hpp"

namespace rehearse::reference {

inline nlohmann::json load(const std::string& file) {
  std::ifstream stream(TEST_DATA_DIR "/" + file);
  return nlohmann::json::parse(stream);
}

/// A number, a flat list (a column) or a list of rows.
inline Matrix matrix(const nlohmann::json& rows) {
  if (rows.is_number()) return Matrix::Constant(1, 1, rows.get<double>());
  const auto size = static_cast<Index>(rows.size());
  if (!rows[0].is_array())
    return Matrix::NullaryExpr(size, 1, [&](Index i) { return rows[static_cast<std::size_t>(i)].get<double>(); });
  Matrix m(size, static_cast<Index>(rows[0].size()));
  for (Index i = 0; i < m.rows(); ++i)
    for (Index j = 0; j < m.cols(); ++j) m(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return m;
}

inline Vector vector(const nlohmann::json& list) { return matrix(list).reshaped(); }

/// The largest difference, relative to the largest expected number, or to 1 where all are 0.
inline double error(const Matrix& value, const Matrix& expected) {
  if (value.rows() != expected.rows() || value.cols() != expected.cols()) return HUGE_VAL;
  const double largest = expected.cwiseAbs().maxCoeff();
  return (value - expected).cwiseAbs().maxCoeff() / (largest > 0 ? largest : 1);
}

}  // namespace rehearse::reference
