#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/core/expected_episode.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"
#include "rehearse/identification/phi_posterior.hpp"
#include "rehearse/learners/store.hpp"
#include "rehearse/policy/policy.hpp"
#include "rehearse/prior/prior.hpp"

namespace rehearse::learners {

/// The number of simulated episodes of a policy that broke a limit.
struct LimitRisk {
  Index broken = 0;
  Index episodes = 0;
};

/// The policy to try next, and what the learner knew when it chose it. What does not apply is empty.
struct Proposal {
  std::shared_ptr<const policy::Policy> policy;  // whose parameters theta are: mostly the setting's
  Vector theta;
  std::optional<double> predicted_return;
  std::vector<LimitRisk> risks;        // of the task's limits, in their order; empty: nothing was simulated for them
  Index rollouts = 0;                  // simulated to choose this policy
  Index failed_rollouts = 0;           // of these, ended by a failed simulation
  std::string failed_row;              // the prior could not simulate, and why; empty: it could, or is not asked
  std::optional<double> log_evidence;  // of the data under the model
  std::optional<Vector> phi;           // of the prior, in the order of its space
  std::optional<identification::PhiPosterior> posterior;  // of its continuous parameters, where it was learned
  std::shared_ptr<const dynamics::DynamicsModel> model;   // that predicted the return; null before there is one
  std::function<ExpectedEpisode()> moments;    // what that model expects of the policy from the task's start,
                                               // by moment matching; empty: it has no analytic moments
  Index left_out_rows = 0;                     // training rows whose prior mean was not finite
  std::vector<std::string> notes;              // numerical failures survived, and what users should know, a line each
  std::shared_ptr<const std::string> archive;  // of elites, as bytes (qd/archive_bytes.hpp)
  double model_s = 0;                          // time spent learning the model
  double search_s = 0;                         // and searching the policy
};

/// A proposal as a run keeps it.
struct KnownProposal {
  std::string policy;  // its name
  Vector theta;
};

/// A table of a learner's trials, for readers of the run folder: NAME.csv there.
struct Table {
  std::string name;                  // "elites"
  std::vector<std::string> columns;  // with units: "x [m]"
  Matrix rows;                       // NaN: does not apply
};

/// Everything a learner is given. It never holds the plant.
struct Setting {
  Task task;
  std::shared_ptr<const policy::Policy> policy;
  std::optional<prior::Prior> prior;
  std::optional<Vector> start;  // θ to begin with, of a learner that takes one; empty: none
  std::uint64_t seed = 1;
  Phase phase = Phase::robot;  // that its trials run on: a field of every random stream
  std::shared_ptr<const Evaluator> evaluator;
  ProgressSink progress;         // may be empty
  std::shared_ptr<Store> store;  // may be null
};

/// Proposes policies and learns from the episodes they make.
///
/// Laws (checked by testing::check_learner): `ask` is idempotent: until the next `tell` it returns the same proposal.
/// A learner whose proposal is restored by `ask_again` goes on as one that found it. The same setting, options and
/// episodes give the same bytes, whatever the evaluator. A learner that loaded what another saved, after being told the
/// same episodes, goes on as that one would, its tables too. One thread at a time calls it; it spreads its own work by
/// the setting's evaluator.
class Learner {
 public:
  virtual ~Learner() = default;
  /// The proposal for the next trial. The reference is valid until `tell`, `load` or the learner's end: copy it to keep
  /// it.
  virtual const Proposal& ask() = 0;
  /// Does what `ask` does, for a caller who has kept the same proposal. Learners whose search takes long leave it out:
  /// policy, θ and model of what is returned are those of `ask`, other fields may be empty.
  virtual const Proposal& ask_again(const KnownProposal& /*known*/) { return ask(); }
  virtual void tell(const Episode& episode) = 0;  // true states and rewards: of the plant, or as measured
                                                  // (Spec::told_by)

  /// Takes episodes of other controllers for data, like those of trials, before the first `ask` or `load`. Throws
  /// InvalidInput if this learner learns from its own policies alone.
  virtual void study(const std::vector<Episode>& logs) {
    if (!logs.empty()) throw InvalidInput("this learner cannot learn from logs of other controllers");
  }

  /// State that is not in the episodes (warm starts); small. Called between `tell` and `ask`.
  virtual nlohmann::json save() const = 0;
  /// Tables of all it was told, if it has any. Called after `tell`, or after `load` with at least one episode.
  virtual std::vector<Table> tables() { return {}; }
  /// The episodes told so far, in order, without the logs, and what `save` returned after the last of them.
  virtual void load(const std::vector<Episode>& episodes, const nlohmann::json& state) = 0;
};

enum class PriorUse { none, required };

/// Options by name, each with its value as text.
using OptionTexts = std::vector<std::pair<std::string, std::string>>;

/// A learner whose options can still be set: what a family's folder gives to the catalogue.
class LearnerBuilder {
 public:
  virtual ~LearnerBuilder() = default;
  virtual std::string name() const = 0;     // "gp-mi"
  virtual std::string summary() const = 0;  // one line for `rehearse list`
  virtual PriorUse prior_use() const = 0;
  virtual bool chooses_priors() const = 0;            // `--prior a,b,c` is allowed
  virtual bool takes_start() const { return false; }  // it may begin with a policy (Setting::start)
  virtual bool tunes_prior() const { return false; }  // with these options it learns parameters of the prior
  virtual void fields(FieldVisitor& v) = 0;
  /// Options of the scenario that suit this learner, where neither a robot's file, nor a preset, nor the user sets
  /// them: the policy that it needs. Those that a scenario does not have, or not with that value, are left as they are.
  virtual OptionTexts scenario_defaults() const { return {}; }
  /// Reasons why these options cannot do with a task or a policy, a line each: wrong input that can be found before
  /// anything is built.
  virtual std::vector<std::string> violations(const Task& /*task*/, const policy::Policy& /*policy*/) const {
    return {};
  }
  /// Parts of a task that the learner ignores, a line each; it takes the task all the same.
  virtual std::vector<std::string> warnings(const Task& /*task*/) const { return {}; }
  virtual std::unique_ptr<Learner> build(Setting setting) const = 0;  // throws InvalidInput
};

}  // namespace rehearse::learners
