#include "random_search.hpp"

#include <nlohmann/json.hpp>

#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/learners/builder.hpp"
#include "rehearse/learners/json.hpp"
#include "rehearse/learners/trial_learner.hpp"
#include "rehearse/rollout/simulate.hpp"

namespace rehearse::learners::random_search {
namespace {

class RandomSearch final : public TrialLearner {
 public:
  RandomSearch(Setting setting, const Options& options) : setting_(std::move(setting)), options_(options) {}

  /// All that does not follow from the episodes: the policies are not in them.
  nlohmann::json save() const override { return {{"best", to_json(best_)}, {"earned", earned_}}; }

 private:
  Proposal propose() override {
    const Matrix Theta = random_policies();
    const Vector phi = setting_.prior->space.values();
    const auto model = std::make_shared<dynamics::SimulatorModel>(*setting_.prior, phi);
    const rollout::Simulation simulation{*model, *setting_.policy, setting_.task, stream()};
    const rollout::Simulated simulated = rollout::simulate(simulation, Theta, {}, *setting_.evaluator);
    Index best = 0;
    const double promised = simulated.returns.row(0).maxCoeff(&best);
    const bool again = trials_ > 0 && earned_ >= promised;
    return {.policy = setting_.policy,
            .theta = again ? best_ : Theta.col(best),
            .predicted_return = again ? earned_ : promised,
            .rollouts = Theta.cols(),
            .failed_rollouts = simulated.failed,
            .phi = phi,
            .model = model};
  }

  void learn(const Proposal& tried, const Episode& episode) override {
    if (trials_ == 0 || episode.total_reward() > earned_) best_ = tried.theta, earned_ = episode.total_reward();
    ++trials_;
  }

  void restore(const std::vector<Episode>& episodes, const nlohmann::json& state) override {
    trials_ = episodes.size();
    best_ = to_vector(state.at("best"));
    earned_ = state.at("earned").get<double>();
  }

  /// One a column.
  Matrix random_policies() const {
    const auto [low, high] = setting_.policy->box().value_or(Interval{-options_.box, options_.box});
    Matrix Theta(setting_.policy->parameters(), options_.policies);
    Rng rng(stream());
    for (double& number : Theta.reshaped()) number = rng.uniform(low, high);
    return Theta;
  }

  /// The random numbers of this trial.
  StreamKey stream() const {
    return {.seed = setting_.seed,
            .trial = trials_ + 1,
            .phase = setting_.phase,
            .stage = Stage::search,
            .purpose = Purpose::random_policy};
  }

  Setting setting_;
  Options options_;
  std::uint64_t trials_ = 0;
  Vector best_;        // the θ tried that earned most
  double earned_ = 0;  // its return
};

}  // namespace

std::unique_ptr<Learner> make(Setting setting, Options options) {
  setting = checked(std::move(setting), options, PriorUse::required);
  return std::make_unique<RandomSearch>(std::move(setting), options);
}

std::vector<std::unique_ptr<LearnerBuilder>> builders() {
  return builders_of(Entry<Options>{
      .name = "random-search", .summary = "the best of many random policies on the prior", .make = make});
}

}  // namespace rehearse::learners::random_search
