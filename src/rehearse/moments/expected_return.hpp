#pragma once
// The expected return of a policy on GPs, a prior or both by moment matching, and its gradient (Deisenroth 2011:
// PILCO's value; Saveriano 2017).

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "rehearse/core/expected_episode.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/moments/analytic_policy.hpp"
#include "rehearse/moments/propagation.hpp"
#include "rehearse/reward/saturating.hpp"

namespace rehearse::moments {

/// Buffers that evaluations reuse. Not shared between threads.
struct ReturnWorkspace {
  std::vector<Gaussian> states;       // T + 1
  std::vector<Transformed> features;  // of these
  std::vector<StepTape> steps;        // T
};

struct Return {
  double value = 0;  // Σ E[r_t], t = 1..T; NaN if it could not be computed
  Vector rewards;    // E[r_t]
  Vector variances;  // of the rewards
  Index steps = 0;   // that could be computed: T, or fewer where the moments were lost
  bool ok() const;   // the value is finite
};

/// θ ↦ Σ_t E[r(x_t)], x_0 ~ start, under the policy at θ on `dynamics`. Immutable; any thread.
class ExpectedReturn {
 public:
  /// dynamics: GPs are of `model_features` with joint angles or without, and actions. Throws InvalidInput with what to
  /// use instead if policy or reward have no analytic moments, and if sizes do not agree. `start`: where not the
  /// task's.
  ExpectedReturn(const Task& task, const policy::Policy& policy, StepDynamics dynamics,
                 std::optional<Gaussian> start = {});

  /// The gradient by θ in reverse mode, unless null; NaN where the value is. The result is the same for any number of
  /// threads. No θ throws but one of another size.
  Return operator()(const ConstVectorView& theta, Vector* gradient, ReturnWorkspace& workspace,
                    const Evaluator& evaluator = serial_evaluator()) const;

  /// The episode whose return that is, as far as there are moments.
  ExpectedEpisode episode(const ConstVectorView& theta, const Evaluator& evaluator = serial_evaluator()) const;

 private:
  bool roll_out(const PolicyMoments& policy, ReturnWorkspace& workspace, Return& result,
                const Evaluator& evaluator) const;
  /// Empty where the prior has no derivatives.
  Vector differentiate(const PolicyMoments& policy, ReturnWorkspace& workspace, const Evaluator& evaluator) const;

  StepDynamics dynamics_;
  FeatureMoments features_;  // inputs of the GPs
  PolicyMomentsAt policy_;
  reward::ClosedForm reward_;
  Gaussian start_;
  Index horizon_;
};

/// The dynamics, made when it is called.
using MakeMoments = std::function<StepDynamics()>;

/// ExpectedReturn::episode from the task's start, computed when it is called: for most proposals, those of episodes on
/// a prior, it never is.
std::function<ExpectedEpisode()> expected_episode(Task task, std::shared_ptr<const policy::Policy> policy,
                                                  MakeMoments dynamics, Vector theta);

}  // namespace rehearse::moments
