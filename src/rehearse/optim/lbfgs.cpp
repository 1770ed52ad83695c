#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/optim/gradient.hpp"
#include "rehearse/optim/nlopt_search.hpp"

namespace rehearse::optim {
namespace {

void check(const Vector& start, const Vector& low, const Vector& high, LbfgsOptions options) {
  Violations violations;
  for (const auto& line : field_violations([&](FieldVisitor& v) { v.group("lbfgs", options); })) violations.add(line);
  if (start.size() == 0 || low.size() != start.size() || high.size() != start.size())
    violations.add(fmt::format("lbfgs: start, low, high have {}, {}, {} coordinates, must be equal and ≥ 1",
                               start.size(), low.size(), high.size()));
  else
    for (Index i = 0; i < start.size(); ++i)
      if (!(start(i) >= low(i) && start(i) <= high(i)))
        violations.add(fmt::format("start[{}] = {}, must be between {} and {}", i, to_text(start(i)), to_text(low(i)),
                                   to_text(high(i))));
  violations.throw_if_any();
}

}  // namespace

GradientResult maximise_lbfgs(const Differentiable& objective, const Vector& start, const Vector& low,
                              const Vector& high, const LbfgsOptions& options) {
  check(start, low, high, options);
  NloptSearch search(
      NLOPT_LD_LBFGS,
      [&](const Vector& x, Vector* gradient) {
        Vector ignored = Vector::Zero(x.size());
        return objective(x, gradient ? *gradient : ignored);
      },
      low, high);
  nlopt_set_ftol_rel(search.settings(), options.relative_tolerance);
  search.maximise(start, options.max_evaluations);
  return {search.best_x, search.best_value, search.evaluations, search.stop};
}

}  // namespace rehearse::optim
