#include "rehearse/optim/nlopt_search.hpp"

#include <cmath>

namespace rehearse::optim {
namespace {

std::string reason(nlopt_result code, bool found) {
  if (!found) return "no finite value";
  return code == NLOPT_MAXEVAL_REACHED ? "max_evaluations" : "converged";
}

}  // namespace

NloptSearch::NloptSearch(nlopt_algorithm algorithm, Objective objective, const Vector& low, const Vector& high)
    : opt_(nlopt_create(algorithm, static_cast<unsigned>(low.size())), nlopt_destroy),
      objective_(std::move(objective)) {
  nlopt_set_max_objective(opt_.get(), &NloptSearch::call, this);
  nlopt_set_lower_bounds(opt_.get(), low.data());
  nlopt_set_upper_bounds(opt_.get(), high.data());
}

void NloptSearch::maximise(const Vector& start, Index max_evaluations) {
  best_x = start;
  nlopt_set_maxeval(opt_.get(), static_cast<int>(max_evaluations));
  Vector x = start;
  double value = 0;
  const nlopt_result code = nlopt_optimize(opt_.get(), x.data(), &value);
  if (thrown_) std::rethrow_exception(thrown_);
  stop = reason(code, std::isfinite(best_value));
}

// Exceptions must not cross NLopt, which is C.
double NloptSearch::call(unsigned n, const double* x, double*, void* self_pointer) {
  auto& self = *static_cast<NloptSearch*>(self_pointer);
  try {
    return self.evaluate(Eigen::Map<const Vector>(x, n));
  } catch (...) {
    self.thrown_ = std::current_exception();
    nlopt_force_stop(self.opt_.get());
    return 0;
  }
}

double NloptSearch::evaluate(const Vector& x) {
  const double value = objective_(x);
  ++evaluations;
  if (!std::isfinite(value)) return -HUGE_VAL;
  if (!(value <= best_value)) {
    best_value = value;
    best_x = x;
  }
  return value;
}

}  // namespace rehearse::optim
