#pragma once

#include <optional>
#include <vector>

#include "rehearse/learners/logs.hpp"
#include "rehearse/learners/pilco/prior_knowledge.hpp"
#include "rehearse/learners/trial_learner.hpp"

namespace rehearse::learners::pilco {

/// Returns that differ by less than this fraction count as equal.
inline constexpr double kSameReturn = 0.02;

/// The trials of PILCO on one system, the robot or, before, the prior. With `Options::prior` they begin with the
/// knowledge from the prior, with `Options::pi_rem` with a policy made for the prior, else with random actions.
class Trials final : public TrialLearner {
 public:
  /// learn_on_prior: called once if `Options::prior` or `pi_rem` is set.
  Trials(Setting setting, const Options& options, LearnOnPrior learn_on_prior = {})
      : setting_(std::move(setting)), options_(options), learn_on_prior_(std::move(learn_on_prior)) {}

  void study(const std::vector<Episode>& logs) override;
  nlohmann::json save() const override;

  /// The GPs behind the proposal of `ask`, summed up by at most so many points; empty: there are none. Without a prior.
  std::vector<moments::MomentTerm> terms(Index inducing, std::vector<std::string>& notes) const;

 private:
  Proposal propose() override { return propose(nullptr); }
  Proposal propose_again(const KnownProposal& known) override { return propose(&known.theta); }
  Proposal propose(const Vector* known);  // θ of this trial, where it was found before
  void learn(const Proposal& tried, const Episode& episode) override;
  void restore(const std::vector<Episode>& episodes, const nlohmann::json& state) override;
  std::uint64_t trial() const { return trials_ + 1; }
  StreamKey stream(Stage stage) const {
    return {.seed = setting_.seed, .trial = trial(), .phase = setting_.phase, .stage = stage};
  }
  void add(const Episode& episode);
  Proposal first_proposal();
  Proposal next_proposal(const Vector* known);
  bool begins_on_prior() const { return options_.prior || options_.pi_rem; }
  void know_prior();
  Mean mean() const;
  Model learn_model() const;
  void search(const Model& model, Proposal& proposal) const;

  Setting setting_;
  Options options_;
  LearnOnPrior learn_on_prior_;
  std::optional<PriorKnowledge> prior_;  // once it is learned
  Logs logs_;
  Dataset data_;                  // logs and trials
  bool solved_ = false;           // by the last trial, as far as known: by its true states, which are noise-free where
  std::optional<double> earned_;  // the plant knows them, unless the run tells measured ones; so is what it earned
  bool repeated_ = false;         // it earned what the one before did
  std::uint64_t trials_ = 0;
  Vector theta_;  // of the last trial; empty before there was one of the setting's policy
  identification::WarmStart state_;
};

}  // namespace rehearse::learners::pilco
