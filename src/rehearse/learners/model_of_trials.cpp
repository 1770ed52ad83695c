#include "rehearse/learners/model_of_trials.hpp"

#include <utility>

#include <nlohmann/json.hpp>

#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/identification/learn.hpp"
#include "rehearse/learners/json.hpp"

namespace rehearse::learners {

using nlohmann::json;

ModelOfTrials::ModelOfTrials(const Setting& setting, identification::Kind kind, double prior_variance)
    : setting_(setting), kind_(std::move(kind)), prior_variance_(prior_variance) {}

void ModelOfTrials::study(const std::vector<Episode>& logs) {
  logs_.add(logs, setting_.task);
  data_ = logs_.rows();
}

void ModelOfTrials::add(const Episode& episode) {
  data_.append(episode);
  ++trials_;
}

identification::WarmStart ModelOfTrials::learn(Proposal& proposal) const {
  if (setting_.progress) setting_.progress({.phase = "model"});
  if (without_data()) {
    trust_prior(proposal, prior_variance_);
    return start_;
  }
  try {
    identification::Learned learned = identification::learn(
        {data_, setting_.task.model_features(), setting_.task.kinematics(), setting_.prior ? &*setting_.prior : nullptr,
         setting_.task.actuators(), setting_.task.state_names()},
        kind_, start_, *setting_.evaluator);
    proposal.model = learned.model;
    proposal.phi = learned.state.phi;
    proposal.posterior = std::move(learned.posterior);
    proposal.log_evidence = learned.log_evidence;
    proposal.left_out_rows = learned.left_out_rows;
    proposal.notes = std::move(learned.notes);
    if (const std::string note = logs_.note(); trials_ == 0 && !note.empty()) proposal.notes.push_back(note);
    return std::move(learned.state);
  } catch (const InvalidInput& failed) {
    if (!setting_.prior) throw;
    trust_prior(proposal, 0);
    if (dynamic_cast<const identification::NoUsableRow*>(&failed)) proposal.left_out_rows = data_.size();
    proposal.notes.push_back(failed.what());
    return start_;
  }
}

void ModelOfTrials::trust_prior(Proposal& proposal, double variance) const {
  proposal.phi = setting_.prior->space.values();
  proposal.model = std::make_shared<dynamics::SimulatorModel>(*setting_.prior, *proposal.phi, variance);
}

void ModelOfTrials::save(json& state) const { state.update(to_json(start_)); }

void ModelOfTrials::restore(const std::vector<Episode>& episodes, const json& state) {
  data_ = logs_.rows();
  trials_ = 0;
  for (const Episode& episode : episodes) add(episode);
  start_ = to_warm_start(state);
}

}  // namespace rehearse::learners
