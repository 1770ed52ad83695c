#pragma once

#include "rehearse/gp/posterior.hpp"

namespace rehearse::gp {

struct Prediction {
  Matrix mean, variance;
};

inline Prediction predict(const Posterior& posterior, const Matrix& F) {
  Prediction p{Matrix(F.rows(), posterior.outputs()), Matrix(F.rows(), posterior.outputs())};
  posterior.predict(F, p.mean, p.variance);
  return p;
}

}  // namespace rehearse::gp
