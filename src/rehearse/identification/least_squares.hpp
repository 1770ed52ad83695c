#pragma once

#include <optional>

#include "rehearse/core/options.hpp"
#include "rehearse/dynamics/residuals.hpp"
#include "rehearse/identification/parameter_search.hpp"

namespace rehearse::identification {

/// The search for the φ of the least squared one-step error.
struct LeastSquares {
  enum class Method {
    gauss_newton,  // from several starts, and Subplex where the prior is not smooth enough for it
    subplex,       // Chatzilygeroudis 2018
  };
  Method method = Method::gauss_newton;
  Index starts = 4;  // of Gauss–Newton: the given one, and points spread over the boxes, while no fit is exact
  optim::SubplexOptions subplex{
      .max_evaluations = 2000, .x_tolerance = 1e-6, .value_tolerance = 1e-6};  // the authors' code
  void fields(FieldVisitor& v) {
    v.choice("method", method, "how the least squared error is found", {"gauss-newton", "subplex"},
             published("subplex"));
    v.integer("starts", starts, "largest number of starting points of Gauss–Newton; an exact fit ends it",
              between(1, 1000));
    v.group("subplex", subplex, kExpert);
  }
};

/// The φ of the least mean squared one-step error. A row that fails is charged the largest squared error at the start,
/// at least the variance of the changes, so that a φ at which rows fail does not win by having fewer of them to
/// predict.
Identified least_squares(const dynamics::Residuals& residuals, const prior::Prior& prior,
                         const std::optional<Vector>& start, const LeastSquares& options);

}  // namespace rehearse::identification
