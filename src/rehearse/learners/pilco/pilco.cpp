#include "rehearse/learners/pilco/pilco.hpp"

#include "rehearse/learners/builder.hpp"
#include "rehearse/learners/pilco/prior_phase.hpp"
#include "rehearse/learners/pilco/prior_search.hpp"
#include "rehearse/learners/pilco/trials.hpp"
#include "rehearse/moments/requirements.hpp"

namespace rehearse::learners::pilco {
namespace {

std::vector<std::string> without_moments(const Options& options, const Task& task, const policy::Policy& policy) {
  const bool joint_angles = options.model.joint_angles;
  const auto user = [&]() -> moments::User {
    if (options.prior) return {"pilco-prior", "the learner black-drops-prior", joint_angles};
    if (options.pi_rem) return {"pi-rem", "the learner black-drops-prior", joint_angles};
    return {"pilco", "the learner black-drops", joint_angles};
  };
  return moments::without_moments(task, policy, user());
}

std::vector<std::string> ignored(const Task& task) {
  if (!task.ended) return {};
  return {"moment matching ignores the task's `ended`: the expected return counts the steps after an early end, too"};
}

PriorUse prior_use(const Options& options) {
  return options.prior || options.pi_rem ? PriorUse::required : PriorUse::none;
}

Entry<Options> entry(const char* name, const char* summary, const Options& options) {
  return {.name = name,
          .summary = summary,
          .prior_use = prior_use(options),
          .tunes_prior = [](const Options& used) { return used.pi_rem && used.pi_rem->identify; },
          .make = make,
          .options = options,
          .violations = without_moments,
          .warnings = ignored,
          .scenario_defaults = {{"policy", "rbf"}}};
}

}  // namespace

std::unique_ptr<Learner> make(Setting setting, Options options) {
  setting = checked(std::move(setting), options, prior_use(options), without_moments);
  if (!options.success_test) setting.task.solved = nullptr;
  return std::make_unique<Trials>(std::move(setting), options, options.pi_rem ? search_on_prior : learn_on_prior);
}

std::vector<std::unique_ptr<LearnerBuilder>> builders() {
  return builders_of(
      entry("pilco", "GPs from data alone, policies (rbf, or linear with a sine) by moment matching and its gradient",
            {}),
      entry("pilco-prior", "PILCO on the prior first, then GPs around those learned there; the same policies",
            {.prior = PriorPhaseOptions{}}),
      entry("pi-rem", "GPs around the prior itself, a first policy made for the prior alone; the same policies",
            {.pi_rem = PiRemOptions{}}));
}

}  // namespace rehearse::learners::pilco
