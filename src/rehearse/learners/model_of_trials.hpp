#pragma once

#include <nlohmann/json_fwd.hpp>

#include "rehearse/identification/fit_problem.hpp"
#include "rehearse/identification/kinds.hpp"
#include "rehearse/learners/learner.hpp"
#include "rehearse/learners/logs.hpp"

namespace rehearse::learners {

/// All episodes given to a learner, and the model that is learned from them before each trial. A part of a learner: one
/// thread.
class ModelOfTrials {
 public:
  /// prior_variance: of predictions before there are data. The setting must outlive it.
  ModelOfTrials(const Setting& setting, identification::Kind kind, double prior_variance = 0);

  void study(const std::vector<Episode>& logs);  // as Learner::study
  void add(const Episode& episode);              // of a trial

  /// True if there are neither trials nor logs.
  bool without_data() const { return trials_ == 0 && logs_.rows().size() == 0; }
  const Dataset& data() const { return data_; }  // of logs and trials

  /// Writes the model, and its properties, into a proposal. Returns the start of the next one, for `keep`: an
  /// interrupted trial leaves nothing behind. The prior is trusted where nothing can be learned.
  identification::WarmStart learn(Proposal& proposal) const;
  void keep(identification::WarmStart start) { start_ = std::move(start); }

  /// Adds to a learner's state, and takes from it; `restore` forgets all trials first.
  void save(nlohmann::json& state) const;
  void restore(const std::vector<Episode>& episodes, const nlohmann::json& state);

 private:
  void trust_prior(Proposal& proposal, double variance) const;

  const Setting& setting_;
  identification::Kind kind_;
  double prior_variance_;
  Logs logs_;
  Dataset data_;
  std::uint64_t trials_ = 0;
  identification::WarmStart start_;
};

}  // namespace rehearse::learners
