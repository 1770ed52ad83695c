#include "rehearse/learners/pilco/pilco.hpp"

#include "rehearse/core/errors.hpp"
#include "rehearse/learners/pilco/prior_phase.hpp"
#include "rehearse/learners/pilco/trials.hpp"
#include "rehearse/moments/requirements.hpp"

namespace rehearse::learners::pilco {
namespace {

std::vector<std::string> without_moments(const Task& task, const policy::Policy& policy, const Options& options) {
  const bool joint_angles = options.model.joint_angles;
  const moments::Need need = options.prior ? moments::Need{"pilco-prior", "the learner black-drops-prior", joint_angles}
                                           : moments::Need{"pilco", "the learner black-drops", joint_angles};
  return moments::without_moments(task, policy, need);
}

class Builder final : public LearnerBuilder {
 public:
  Builder(std::string name, std::string summary, std::optional<PriorPhaseOptions> prior)
      : name_(std::move(name)), summary_(std::move(summary)) {
    options_.prior = prior;
  }
  std::string name() const override { return name_; }
  std::string summary() const override { return summary_; }
  PriorUse prior_use() const override { return options_.prior ? PriorUse::required : PriorUse::none; }
  bool chooses_priors() const override { return false; }
  void fields(FieldVisitor& v) override { options_.fields(v); }
  std::vector<std::string> violations(const Task& task, const policy::Policy& policy) const override {
    return without_moments(task, policy, options_);
  }
  std::unique_ptr<Learner> build(Setting setting) const override { return make(std::move(setting), options_); }

 private:
  std::string name_, summary_;
  Options options_;
};

}  // namespace

std::unique_ptr<Learner> make(Setting setting, Options options) {
  Violations violations;
  for (const auto& line : field_violations([&](FieldVisitor& v) { options.fields(v); })) violations.add(line);
  for (const auto& line : setting.task.violations()) violations.add(line);
  violations.require(static_cast<bool>(setting.policy), "this learner needs a policy");
  if (setting.policy)
    for (const auto& line : without_moments(setting.task, *setting.policy, options)) violations.add(line);
  violations.require(!options.prior || setting.prior, "this learner needs a prior");
  violations.throw_if_any();
  if (!options.prior) setting.prior.reset();
  if (!options.success_test) setting.task.solved = nullptr;
  if (!setting.evaluator) setting.evaluator = make_thread_evaluator(1);
  return std::make_unique<Trials>(std::move(setting), options, learn_on_prior);
}

std::vector<std::unique_ptr<LearnerBuilder>> builders() {
  std::vector<std::unique_ptr<LearnerBuilder>> all;
  const auto add = [&](const char* name, const char* summary, std::optional<PriorPhaseOptions> prior) {
    all.push_back(std::make_unique<Builder>(name, summary, prior));
  };
  add("pilco",
      "GPs from data alone, policies by moment matching and its gradient; needs policy=rbf, or a linear one with a "
      "sine",
      {});
  add("pilco-prior", "PILCO on the prior first, then GPs around those learned there; needs the same policies",
      PriorPhaseOptions{});
  return all;
}

}  // namespace rehearse::learners::pilco
