#include "rehearse/learners/ite/ite.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/episode_fit.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/stopwatch.hpp"
#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/files/checksum.hpp"
#include "rehearse/learners/builder.hpp"
#include "rehearse/learners/start_policy.hpp"
#include "rehearse/learners/trial_learner.hpp"

namespace rehearse::learners::ite {
namespace {

using nlohmann::json;

constexpr std::uint64_t kUnknown = 0;

/// The least return of a policy.
double floor_of(const Task& task) { return static_cast<double>(task.horizon) * task.reward_floor; }

struct Trial {
  double total_reward = 0;
  bool fell = false, cut_short = false;
  bool learned = false;  // the expectations use it
};

class Ite final : public TrialLearner {
 public:
  Ite(Setting setting, Options options) : setting_(std::move(setting)), options_(std::move(options)) {}

  std::vector<Table> tables() override {
    prepare();  // after `load` there is no archive yet
    return {elites(), tried()};
  }

  void study(const std::vector<Episode>& logs) override {
    if (!logs.empty())
      throw InvalidInput("ite learns what its own policies earn: logs of other controllers say nothing of that");
  }

  json save() const override {
    return {{"tried", tried_}, {"archive", bytes_ ? files::checksum(*bytes_) : learned_in_}};
  }

 private:
  void learn(const Proposal&, const Episode& episode) override {
    require_fit(episode, setting_.task);
    tried_.push_back(elite_);
    add(episode);
    adapt(trials_.size() - 1);
  }

  void restore(const std::vector<Episode>& episodes, const json& state) override {
    state.at("tried").get_to(tried_);
    learned_in_ = state.value("archive", kUnknown);
    if (tried_.size() != episodes.size()) throw InvalidInput("the learner's state does not fit the episodes");
    trials_.clear();
    for (const Episode& episode : episodes) add(episode);
    adaptation_.reset();
  }

  void add(const Episode& episode) {
    trials_.push_back({episode.total_reward(), episode.ended, episode.is_cut_short(setting_.task.horizon)});
  }

  Proposal propose() override {
    Proposal proposal{.policy = setting_.policy};
    proposal.search_s = seconds([&] { prepare(); });
    elite_ = adaptation_->stopped().empty() ? adaptation_->next() : best_tried();
    proposal.theta = search_->archive.solution(elite_);
    proposal.predicted_return = unit_ * adaptation_->means()(elite_);
    proposal.phi = setting_.prior->space.values();
    proposal.model = std::make_shared<dynamics::SimulatorModel>(*setting_.prior, *proposal.phi);
    proposal.archive = bytes_;
    if (trials_.empty()) {
      proposal.rollouts = static_cast<Index>(search_->evaluations);
      proposal.failed_rollouts = static_cast<Index>(search_->failed);
    }
    if (!adaptation_->stopped().empty() && trials_.back().learned)
      proposal.notes.push_back("the best policy is tried again from now on: " + adaptation_->stopped());
    return proposal;
  }

  /// The archive, and what was learned of it so far.
  void prepare() {
    if (adaptation_) return;
    if (!search_) {
      search_ = illuminate(setting_, options_.archive);
      bytes_ = std::make_shared<std::string>(to_bytes(*search_));
      check_archive();
    }
    const qd::Archive& archive = search_->archive;
    const double best = archive.statistics().best;
    fall_scores_zero_ = best > 0;
    unit_ = best > 0 ? best : best - floor_of(setting_.task);
    if (!(unit_ > 0)) unit_ = 1;  // nothing earns more than failing
    Matrix descriptors(archive.niches().dimensions(), archive.size());
    Vector promised(archive.size());
    for (Index e = 0; e < archive.size(); ++e) {
      descriptors.col(e) = archive.niches().to_unit(archive.descriptor(e));
      promised(e) = archive.performance(e) / unit_;
    }
    adaptation_.emplace(std::move(descriptors), std::move(promised), options_.adaptation);
    for (std::size_t trial = 0; trial < trials_.size(); ++trial) adapt(trial);
  }

  /// Throws if the archive is another than the run's: trials refer to elites by number.
  void check_archive() {
    if (learned_in_ == kUnknown || learned_in_ == files::checksum(*bytes_)) return;
    search_.reset();
    throw InvalidInput(options_.archive.file.empty()
                           ? "the archive that can be made now is not the one that the run began with"
                           : fmt::format("archive.file = {}: it is not the archive that the run began with, which its "
                                         "folder has as archive.bin",
                                         options_.archive.file));
  }

  /// All elites: what the archive promises, and what is expected of them after the trials.
  Table elites() const {
    const qd::Archive& archive = search_->archive;
    const Index D = archive.niches().dimensions();
    Table table{"elites", setting_.task.descriptor_labels(), Matrix(archive.size(), D + 3)};
    for (const char* column : {"promised", "expected", "deviation"}) table.columns.emplace_back(column);
    for (Index e = 0; e < archive.size(); ++e) {
      table.rows.row(e).head(D) = archive.descriptor(e).transpose();
      table.rows(e, D) = archive.performance(e);
    }
    table.rows.col(D + 1) = unit_ * adaptation_->means();
    table.rows.col(D + 2) = unit_ * adaptation_->deviations();
    return table;
  }

  /// The elite that each trial tried; learned: the expectations use that trial.
  Table tried() const {
    const auto trials = static_cast<Index>(tried_.size());
    Table table{"tried", {"trial", "elite", "promised", "learned"}, Matrix(trials, 4)};
    for (Index trial = 0; trial < trials; ++trial) {
      const Index elite = tried_[static_cast<std::size_t>(trial)];
      table.rows.row(trial) << static_cast<double>(trial + 1), static_cast<double>(elite + 1),
          search_->archive.performance(elite), trials_[static_cast<std::size_t>(trial)].learned ? 1 : 0;
    }
    return table;
  }

  /// The return; a fall scores 0 (the authors' code), unless nothing is promised to be better than that.
  double performance(const Trial& trial) const { return trial.fell && fall_scores_zero_ ? 0 : trial.total_reward; }

  /// The elite of the trial that earned most, of those that something was learned from. A fall earns what it earns.
  Index best_tried() const {
    const auto less = [](const Trial& a, const Trial& b) {
      return a.learned && b.learned ? a.total_reward < b.total_reward : b.learned && !a.learned;
    };
    return tried_[static_cast<std::size_t>(std::ranges::max_element(trials_, less) - trials_.begin())];
  }

  void adapt(std::size_t trial) {
    if (tried_[trial] < 0 || tried_[trial] >= search_->archive.size())
      throw InvalidInput(fmt::format("trial {}: the archive has no elite {}", trial + 1, tried_[trial]));
    if (trials_[trial].cut_short) return;  // its elite stays to be tried
    const Index before = adaptation_->trials();
    adaptation_->observe(tried_[trial], performance(trials_[trial]) / unit_);
    trials_[trial].learned = adaptation_->trials() > before;
  }

  Setting setting_;
  Options options_;
  std::shared_ptr<const qd::Search> search_;
  std::shared_ptr<const std::string> bytes_;  // of the search
  double unit_ = 1;                           // of performance: the best in the archive, where that is above 0
  bool fall_scores_zero_ = true;              // something is promised that is better than that
  std::optional<Adaptation> adaptation_;
  std::uint64_t learned_in_ = kUnknown;  // the checksum of the archive that `tried_` are in, where they were loaded
  std::vector<Index> tried_;             // elites
  std::vector<Trial> trials_;
  Index elite_ = 0;  // of the proposal
};

std::vector<std::string> violations_with(const Options& options, const Task& task, const policy::Policy& policy) {
  return violations(options.archive, task, policy);
}

}  // namespace

void Options::fields(FieldVisitor& v) {
  v.group("archive", archive);
  v.group("adaptation", adaptation);
}

std::unique_ptr<Learner> make(Setting setting, Options options) {
  options.archive = for_seed(std::move(options.archive), setting.seed);
  setting = checked(std::move(setting), options, PriorUse::required, violations_with);
  if (setting.start) {
    const bool made = options.archive.file.empty();
    if (!made || options.archive.search.examples == 0)
      throw InvalidInput(fmt::format("the policy to begin with has no effect: {}",
                                     made ? "archive.search.examples = 0, so that no solution is drawn near it"
                                          : "archive.file names an archive that was made before"));
    require_start_in_box(setting, options.archive.box, "archive.box");
  }
  return std::make_unique<Ite>(std::move(setting), std::move(options));
}

std::vector<std::unique_ptr<LearnerBuilder>> builders() {
  return builders_of(Entry<Options>{
      .name = "ite",
      .summary = "an archive of different policies made on the prior, and Bayesian optimisation among them",
      .takes_start = true,
      .make = make,
      .violations = violations_with});
}

}  // namespace rehearse::learners::ite
