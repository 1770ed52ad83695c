#pragma once
// A maximisation by NLopt that survives exceptions and values that are not finite.

#include <functional>
#include <memory>
#include <string>

#include <nlopt.h>

#include "rehearse/core/types.hpp"

namespace rehearse::optim {

class NloptSearch {
 public:
  using Objective = std::function<double(const Vector& x)>;

  NloptSearch(nlopt_algorithm algorithm, Objective objective, const Vector& low, const Vector& high);

  nlopt_opt settings() { return opt_.get(); }

  /// Searches from `start`; throws what the objective threw.
  void maximise(const Vector& start, Index max_evaluations);

  Vector best_x;  // the start as long as no value was finite
  double best_value = kNaN;
  Index evaluations = 0;
  std::string stop;

 private:
  static double call(unsigned n, const double* x, double* gradient, void* self);
  double evaluate(const Vector& x);

  std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> opt_;
  Objective objective_;
  std::exception_ptr thrown_;
};

}  // namespace rehearse::optim
