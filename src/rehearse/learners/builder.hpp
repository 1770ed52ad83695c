#pragma once
// The pieces that bring a family of learners into the catalogue: options with fields(), make(setting, options), an
// Entry.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rehearse/core/errors.hpp"
#include "rehearse/learners/learner.hpp"

namespace rehearse::learners {

/// A learner as the catalogue has it, made from a struct of options with fields().
template <class Options>
struct Entry {
  std::string name;     // "gp-mi"
  std::string summary;  // one line for `rehearse list`
  PriorUse prior_use = PriorUse::required;
  bool chooses_priors = false;                    // `--prior a,b,c` is allowed
  bool takes_start = false;                       // Setting::start
  bool (*tunes_prior)(const Options&) = nullptr;  // with these it learns parameters of the prior; null: never
  std::unique_ptr<Learner> (*make)(Setting, Options) = nullptr;
  Options options = {};
  std::vector<std::string> (*violations)(const Options&, const Task&, const policy::Policy&) = nullptr;  // may be null
  std::vector<std::string> (*warnings)(const Task&) = nullptr;                                           // may be null
  OptionTexts scenario_defaults = {};  // options of the scenario that suit it, where nobody sets them
};

/// Builds learners as an entry says.
template <class Options>
class OptionsBuilder final : public LearnerBuilder {
 public:
  explicit OptionsBuilder(Entry<Options> entry) : entry_(std::move(entry)) {}

  std::string name() const override { return entry_.name; }
  std::string summary() const override { return entry_.summary; }
  PriorUse prior_use() const override { return entry_.prior_use; }
  bool chooses_priors() const override { return entry_.chooses_priors; }
  bool takes_start() const override { return entry_.takes_start; }
  bool tunes_prior() const override { return entry_.tunes_prior && entry_.tunes_prior(entry_.options); }
  OptionTexts scenario_defaults() const override { return entry_.scenario_defaults; }
  void fields(FieldVisitor& v) override { entry_.options.fields(v); }
  std::vector<std::string> violations(const Task& task, const policy::Policy& policy) const override {
    return entry_.violations ? entry_.violations(entry_.options, task, policy) : std::vector<std::string>{};
  }
  std::vector<std::string> warnings(const Task& task) const override {
    return entry_.warnings ? entry_.warnings(task) : std::vector<std::string>{};
  }
  std::unique_ptr<Learner> build(Setting setting) const override {
    return entry_.make(std::move(setting), entry_.options);
  }

 private:
  Entry<Options> entry_;
};

/// Makes the list that the header of a family declares.
template <class... Options>
std::vector<std::unique_ptr<LearnerBuilder>> builders_of(Entry<Options>... entries) {
  std::vector<std::unique_ptr<LearnerBuilder>> all;
  (all.push_back(std::make_unique<OptionsBuilder<Options>>(std::move(entries))), ...);
  return all;
}

/// The setting with an evaluator, and without a prior where none is used. Throws InvalidInput with all that is wrong
/// with it and the options. `violations`: what these say of a task and a policy; may be null.
template <class Options>
Setting checked(Setting setting, Options& options, PriorUse prior_use,
                std::vector<std::string> (*violations)(const Options&, const Task&, const policy::Policy&) = nullptr) {
  Violations found;
  found.add(field_violations([&](FieldVisitor& v) { options.fields(v); }));
  found.add(setting.task.violations());
  found.require(static_cast<bool>(setting.policy), "this learner needs a policy");
  if (setting.policy && violations) found.add(violations(options, setting.task, *setting.policy));
  found.require(prior_use == PriorUse::none || setting.prior, "this learner needs a prior");
  found.throw_if_any();
  if (prior_use == PriorUse::none) setting.prior.reset();
  if (!setting.evaluator) setting.evaluator = make_thread_evaluator(1);
  return setting;
}

}  // namespace rehearse::learners
