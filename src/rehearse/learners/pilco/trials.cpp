#include "rehearse/learners/pilco/trials.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "rehearse/core/episode_fit.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/stopwatch.hpp"
#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/learners/json.hpp"
#include "rehearse/learners/pilco/initial_policy.hpp"
#include "rehearse/moments/expected_return.hpp"
#include "rehearse/moments/network_prior.hpp"
#include "rehearse/moments/requirements.hpp"
#include "rehearse/policy/schedule.hpp"

namespace rehearse::learners::pilco {
namespace {

using learners::to_json;
using nlohmann::json;

/// A policy that was learned on the prior, before anything is known of the robot.
Proposal proposal_of(const PriorKnowledge& knowledge, const Setting& setting, const Options& options) {
  const prior::Prior& given = *setting.prior;
  const Task& task = setting.task;
  const FeatureMap features = moments::model_features(task, options.model.joint_angles);
  const prior::Prior model =
      knowledge.network.empty() ? given : moments::network_prior(given.name, features, knowledge.network);
  Proposal proposal{.policy = setting.policy,
                    .theta = knowledge.theta,
                    .predicted_return = knowledge.predicted_return,
                    .rollouts = knowledge.evaluations,
                    .failed_rollouts = knowledge.failed,
                    .model = std::make_shared<dynamics::SimulatorModel>(model, model.space.values()),
                    .notes = knowledge.notes};
  moments::MakeMoments moments;
  if (options.pi_rem)
    moments = [given, states = task.state_size(), actions = task.action_size(), through = options.pi_rem->through] {
      return moments::StepDynamics(nullptr,
                                   moments::make_prior_moments(given, given.space.values(), states, actions, through));
    };
  else if (!knowledge.network.empty())
    moments = [network = knowledge.network, states = task.state_size()] {
      return moments::StepDynamics(std::make_shared<moments::MomentMatching>(network, states));
    };
  if (moments) proposal.moments = moments::expected_episode(task, setting.policy, moments, proposal.theta);
  return proposal;
}

Proposal random_actions(const Setting& setting, double hold_s, const StreamKey& key) {
  const Task& task = setting.task;
  return {.policy = policy::make_schedule(task),
          .theta = policy::random_schedule(task, policy::RandomActions::uniform, hold_s, key)};
}

}  // namespace

void Trials::learn(const Proposal& tried, const Episode& episode) {
  require_fit(episode, setting_.task);
  if (tried.policy == setting_.policy) theta_ = tried.theta;
  add(episode);
  ++trials_;
}

void Trials::add(const Episode& episode) {
  data_.append(episode);
  if (episode.is_cut_short(setting_.task.horizon)) {  // it says nothing of what the policy earns
    repeated_ = solved_ = false;
    earned_.reset();
    return;
  }
  const double earned = episode.total_reward();
  repeated_ = earned_ && std::abs(earned - *earned_) <= kSameReturn * std::abs(*earned_);
  earned_ = earned;
  solved_ = setting_.task.solved && setting_.task.solved(episode);
}

std::vector<moments::MomentTerm> Trials::terms(Index inducing, std::vector<std::string>& notes) const {
  if (!asked() || !asked()->model) return {};
  ModelOptions options = options_.model;
  options.inducing = inducing;
  return terms_of({setting_.task, data_, options, *setting_.evaluator, setting_.progress}, state_.kernels, notes);
}

json Trials::save() const {
  json state = to_json(state_);
  state["trials"] = trials_;
  state["theta"] = to_json(theta_);
  if (prior_) state["prior"] = to_json(*prior_);
  return state;
}

void Trials::restore(const std::vector<Episode>& episodes, const json& state) {
  data_ = logs_.rows();
  solved_ = false;
  earned_.reset();
  repeated_ = false;
  state_ = to_warm_start(state);
  prior_.reset();
  for (const Episode& episode : episodes) add(episode);
  theta_ = to_vector(state.at("theta"));
  trials_ = state.at("trials").get<std::uint64_t>();
  if (state.contains("prior")) prior_ = to_knowledge(state.at("prior"));
  const bool fits = trials_ == episodes.size() && (trials_ == 0 || !begins_on_prior() || prior_);
  if (!fits) throw InvalidInput("the learner's state does not fit the episodes");
}

void Trials::study(const std::vector<Episode>& logs) {
  logs_.add(logs, setting_.task);
  data_ = logs_.rows();
}

Proposal Trials::propose(const Vector* known) {
  Proposal proposal = trials_ == 0 && logs_.rows().size() == 0 ? first_proposal() : next_proposal(known);
  if (prior_ && !proposal.phi) proposal.phi = setting_.prior->space.values();
  return proposal;
}

Proposal Trials::first_proposal() {
  if (!begins_on_prior()) return random_actions(setting_, options_.first_trial_hold_s, stream(Stage::episode));
  const Stopwatch watch;
  know_prior();
  Proposal proposal = proposal_of(*prior_, setting_, options_);
  proposal.search_s = watch.seconds();
  return proposal;
}

void Trials::know_prior() {
  if (begins_on_prior() && !prior_) prior_ = learn_on_prior_(setting_, options_);
}

Proposal Trials::next_proposal(const Vector* known) {
  Proposal proposal{.policy = setting_.policy};
  if (trials_ == 0) {  // there are logs
    know_prior();
    if (prior_) theta_ = prior_->theta;
  }
  Model model;
  proposal.model_s = seconds([&] { model = learn_model(); });
  proposal.model = model.model;
  proposal.notes = std::move(model.notes);
  if (const std::string note = logs_.note(); trials_ == 0 && !note.empty()) proposal.notes.push_back(note);
  if (options_.pi_rem) proposal.phi = model.state.phi;
  proposal.posterior = std::move(model.posterior);
  proposal.left_out_rows = model.left_out_rows;
  if (std::isfinite(model.log_evidence)) proposal.log_evidence = model.log_evidence;
  proposal.theta = theta_.size() > 0 ? theta_
                                     : initial_policy(*setting_.policy, start_state(setting_.task, options_.search),
                                                      stream(Stage::search));
  if (known)
    proposal.theta = *known;
  else if (model.moments)
    proposal.search_s = seconds([&] { search(model, proposal); });
  if (model.model)
    proposal.moments =
        moments::expected_episode(setting_.task, setting_.policy, std::move(model.moments_of_all_rows), proposal.theta);
  state_ = std::move(model.state);  // last: an interruption must not leave it behind
  return proposal;
}

Mean Trials::mean() const {
  if (options_.pi_rem)
    return {.prior = &*setting_.prior, .through = options_.pi_rem->through, .identify = options_.pi_rem->identify};
  return {.network = prior_ ? prior_->network : std::vector<moments::MomentTerm>()};
}

Model Trials::learn_model() const {
  if (setting_.progress) setting_.progress({.phase = "model"});
  return pilco::learn({setting_.task, data_, options_.model, *setting_.evaluator, setting_.progress}, state_, mean());
}

/// Searches from the proposal's θ. A policy that has solved the task is good enough to stay with. One that was tried
/// twice is worth what it earned: moment matching may promise more than that forever.
void Trials::search(const Model& model, Proposal& proposal) const {
  Restarts restarts{.key = stream(Stage::search)};
  if (prior_) restarts.policies = prior_->policies;
  const SearchProblem problem{model.moments, *setting_.policy, setting_.task, *setting_.evaluator, setting_.progress};
  SearchResult found = solved_ ? search_policy(problem, proposal.theta, options_.search)
                               : search_with_restarts(problem, proposal.theta, options_.search, restarts,
                                                      repeated_ ? earned_ : std::nullopt);
  proposal.theta = std::move(found.theta);
  proposal.predicted_return = found.predicted_return;
  proposal.rollouts = found.evaluations;
  proposal.failed_rollouts = found.failed;
  if (!found.predicted_return)
    proposal.notes.emplace_back("the policy stays: its expected return on the model could not be computed");
}

}  // namespace rehearse::learners::pilco
