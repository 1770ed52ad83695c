#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "rehearse/learners/learner.hpp"

namespace rehearse::learners {

/// A learner that computes one proposal a trial, at the first `ask`, and keeps it until the next `tell`.
class TrialLearner : public Learner {
 public:
  const Proposal& ask() final {
    if (!proposal_) proposal_ = propose();
    return *proposal_;
  }
  const Proposal& ask_again(const KnownProposal& known) final {
    if (!proposal_) proposal_ = propose_again(known);
    return *proposal_;
  }
  void tell(const Episode& episode) final {
    learn(ask(), episode);
    proposal_.reset();
  }
  void load(const std::vector<Episode>& episodes, const nlohmann::json& state) final {
    proposal_.reset();
    restore(episodes, state);
  }

 protected:
  /// An interruption, which throws, must leave everything as it was.
  virtual Proposal propose() = 0;
  /// Proposes the same again where policy and θ are known; a search that takes long is left out.
  virtual Proposal propose_again(const KnownProposal& /*known*/) { return propose(); }
  virtual void learn(const Proposal& tried, const Episode& episode) = 0;
  /// Replaces all that was learned by these episodes and what `save` returned after the last of them.
  virtual void restore(const std::vector<Episode>& episodes, const nlohmann::json& state) = 0;

  /// The proposal that is kept; null: none was asked for since the last episode.
  const Proposal* asked() const { return proposal_ ? &*proposal_ : nullptr; }

 private:
  std::optional<Proposal> proposal_;
};

}  // namespace rehearse::learners
