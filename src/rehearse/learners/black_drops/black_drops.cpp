#include "rehearse/learners/black_drops/black_drops.hpp"

#include <algorithm>
#include <iterator>

#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/stopwatch.hpp"
#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/learners/black_drops/moments.hpp"
#include "rehearse/learners/json.hpp"
#include "rehearse/policy/schedule.hpp"

namespace rehearse::learners::black_drops {
namespace {

using nlohmann::json;

constexpr double kOften = 0.5;  // imagined episodes that solve the task: enough for a trial
constexpr double kMeans = 0.1;  // and what it counts to solve it without doubts

class BlackDrops final : public Learner {
 public:
  BlackDrops(Setting setting, Options options)
      : setting_(std::move(setting)), options_(std::move(options)), features_(setting_.task.feature_map()) {}

  const Proposal& ask() override {
    if (!proposal_) proposal_ = propose();
    return *proposal_;
  }

  void tell(const Episode& episode) override {
    const Proposal& asked = ask();
    policies_.push_back(asked.theta);
    add(episode);
    proposal_.reset();
  }

  json save() const override {
    json kernels = json::array(), policies = json::array(), carried = json::array();
    for (const auto& kernel : state_.kernels) kernels.push_back(to_json(kernel.flat()));
    for (const Vector& theta : policies_) policies.push_back(to_json(theta));
    for (const Vector& theta : carried_) carried.push_back(to_json(theta));
    return {{"kernels", kernels},
            {"kernel_inputs", state_.kernels.empty() ? 0 : state_.kernels.front().inputs()},
            {"phi", state_.phi ? to_json(*state_.phi) : json()},
            {"policies", policies},
            {"carried", carried}};
  }

  void load(const std::vector<Episode>& episodes, const json& state) override {
    data_ = {};
    returns_.clear();
    proposal_.reset();
    for (const Episode& episode : episodes) add(episode);
    policies_ = to_vectors(state.at("policies"));
    carried_ = to_vectors(state.at("carried"));
    state_ = {};
    for (const Vector& flat : to_vectors(state.at("kernels")))
      state_.kernels.push_back(gp::Hyperparameters::from_flat(flat, state.at("kernel_inputs").get<Index>()));
    if (!state.at("phi").is_null()) state_.phi = to_vector(state.at("phi"));
    if (policies_.size() != episodes.size()) throw InvalidInput("the learner's state does not fit the episodes");
  }

 private:
  void add(const Episode& episode) {
    data_.append(episode);
    returns_.push_back(episode.total_reward());
  }

  std::uint64_t trial() const { return returns_.size() + 1; }

  Proposal propose() {
    Proposal proposal{.policy = setting_.policy};
    if (returns_.empty() && !setting_.prior) {
      propose_at_random(proposal);
      return proposal;
    }
    const bool has_moments = without_moments(options_, setting_.task, *setting_.policy).empty();
    // What an interruption must not leave behind is assigned last.
    identification::WarmStart state = state_;
    std::vector<Vector> carried = carried_;
    Task task = setting_.task;
    proposal.model_s = seconds([&] {
      learn_model(proposal, state);
      if (options_.reward.learned) learn_reward(proposal, task);
    });
    std::optional<moments::ExpectedReturn> expected;
    if (options_.search.evaluation == Evaluation::moments)
      expected.emplace(task, *setting_.policy, moments_of(options_, task, data_, state.kernels));
    proposal.search_s = seconds([&] { search(proposal, task, expected ? &*expected : nullptr, carried); });
    if (has_moments)
      proposal.moments = moments::expected_episode(
          setting_.task, setting_.policy,
          [options = options_, task = setting_.task, data = data_, kernels = state.kernels] {
            return moments_of(options, task, data, kernels);
          },
          proposal.theta);
    state_ = std::move(state);
    carried_ = std::move(carried);
    return proposal;
  }

  void propose_at_random(Proposal& proposal) const {
    if (options_.first_trial.kind == FirstTrial::Kind::policy) {
      proposal.theta = random_policy(*setting_.policy, options_.search, stream(Stage::episode));
      return;
    }
    const Task& task = setting_.task;
    proposal.policy = policy::make_schedule(task.action_bounds(), task.dt_s, task.horizon);
    const bool extremes = options_.first_trial.kind == FirstTrial::Kind::extremes;
    proposal.theta =
        policy::random_schedule(task, extremes ? policy::RandomActions::extremes : policy::RandomActions::uniform,
                                options_.first_trial.hold_s, stream(Stage::episode));
  }

  void learn_model(Proposal& proposal, identification::WarmStart& state) {
    if (setting_.progress) setting_.progress({.phase = "model"});
    if (returns_.empty()) return trust_prior(proposal, options_.prior_variance);
    try {
      identification::Learned learned = identification::learn(
          data_, setting_.task.model_features(), setting_.task.kinematics(),
          setting_.prior ? &*setting_.prior : nullptr, options_.model, state, *setting_.evaluator);
      proposal.model = learned.model;
      proposal.phi = learned.state.phi;
      proposal.posterior = std::move(learned.posterior);
      proposal.log_evidence = learned.log_evidence;
      proposal.left_out_rows = learned.left_out_rows;
      proposal.notes = std::move(learned.notes);
      state = std::move(learned.state);
    } catch (const InvalidInput& nothing_to_learn_from) {
      if (!setting_.prior) throw;
      trust_prior(proposal, 0);
      proposal.left_out_rows = data_.size();
      proposal.notes.push_back(nothing_to_learn_from.what());
    }
  }

  /// Replaces the task's reward by what is believed of it.
  void learn_reward(Proposal& proposal, Task& task) const {
    if (returns_.empty()) {
      task.reward = task.initial_reward;
      return;
    }
    identification::LearnedReward learned = identification::learn_reward(data_, features_, options_.reward);
    task.reward = std::move(learned.reward);
    task.saturating_reward.reset();
    if (proposal.log_evidence) *proposal.log_evidence += learned.log_evidence;
    for (std::string& note : learned.notes) proposal.notes.push_back(std::move(note));
  }

  void trust_prior(Proposal& proposal, double variance) const {
    proposal.phi = setting_.prior->space.values();
    proposal.model = std::make_shared<dynamics::SimulatorModel>(*setting_.prior, *proposal.phi, variance);
  }

  void search(Proposal& proposal, const Task& task, const moments::ExpectedReturn* expected,
              std::vector<Vector>& carried) const {
    const SearchProblem problem{*proposal.model,     *setting_.policy,  task,
                                *setting_.evaluator, setting_.progress, expected};
    std::vector<Vector> starts = known_policies();
    std::optional<SearchResult> scouted;
    if (options_.scout.policies > 0 && options_.search.imagine.sample && !returns_.empty()) {
      scouted = search_means(problem, starts, 0, proposal);
      if (keeps_its_promise(*scouted, problem, proposal)) {
        carry(scouted->runners_up, carried);
        const auto again = [&](Index i) { return search_means(problem, {proposal.theta}, i, proposal); };
        return insist_surely(problem, std::move(*scouted), again, proposal);
      }
      starts.push_back(scouted->theta);
      const auto others = std::min(options_.scout.policies - 1, static_cast<Index>(scouted->runners_up.size()));
      starts.insert(starts.end(), scouted->runners_up.begin(), scouted->runners_up.begin() + others);
    }
    const auto search_from = [&](const std::vector<Vector>& from, Index i) {
      SearchResult found = search_policy(problem, from, options_.search, stream(Stage::search, i));
      count(found, proposal);
      return found;
    };
    const Index searches = returns_.empty() ? options_.prior_searches : 1;
    SearchResult found;
    for (Index i = 0; i < searches; ++i) {
      found = search_from(starts, i);
      starts = {found.theta};
    }
    take(found, proposal);
    carry(found.runners_up, carried);
    if (returns_.empty())  // the prior is taken at its word
      return insist_surely(
          problem, std::move(found), [&](Index i) { return search_from({proposal.theta}, searches - 1 + i); },
          proposal);
    if (scouted) {
      found.runners_up.push_back(scouted->theta);
      std::move(scouted->runners_up.begin(), scouted->runners_up.end(), std::back_inserter(found.runners_up));
    }
    insist_doubtfully(problem, std::move(found), proposal);
    const double gain = options_.explore.gain;
    if (gain == 0 || !options_.search.imagine.sample || first_return() == returns_.end()) return;
    if (promises(*proposal.predicted_return, gain)) return;
    if (!scouted) scouted = search_means(problem, known_policies(), 0, proposal);
    if (promises(scouted->predicted_return, options_.explore.promise)) take(*scouted, proposal);
  }

  /// Whether the model's doubts cost the policy next to nothing; if so it is the proposal.
  bool keeps_its_promise(const SearchResult& scouted, const SearchProblem& problem, Proposal& proposal) const {
    const SearchResult judged = with_doubts(problem, scouted.theta, proposal);
    if (!keeps(judged, scouted.predicted_return, options_.scout.tolerance)) return false;
    take(judged, proposal);
    return true;
  }

  /// What a policy promises where the model's doubts count.
  SearchResult with_doubts(const SearchProblem& problem, const Vector& theta, Proposal& proposal) const {
    SearchResult judged = judge(problem, theta, options_.search, stream(Stage::judging));
    count(judged, proposal);
    return judged;
  }

  /// Whether it falls short of the promise by no more than a fraction of it.
  static bool keeps(const SearchResult& found, double promise, double tolerance) {
    return found.predicted_return >= promise - tolerance * std::abs(promise);
  }

  /// Goes on until a policy is found that often solves the task in the model and promises about as much as the best
  /// one, which is the proposal. again(i): the i-th search more. The policy that most often does, if any.
  template <class Again>
  std::optional<SearchResult> insist(const SearchProblem& problem, SearchResult found, Again again, double tolerance,
                                     Proposal& proposal) const {
    std::optional<SearchResult> solving;
    if (!problem.task.solved) return solving;
    for (Index i = 1;; ++i) {
      if (auto judged = best_that_solves(problem, std::move(found), proposal))
        if (!solving || judged->solving > solving->solving) solving = std::move(judged);
      if (solving && solving->solving >= kOften && keeps(*solving, *proposal.predicted_return, tolerance)) break;
      if (i > options_.insist.searches) break;
      found = again(i);
      if (found.predicted_return > *proposal.predicted_return) take(found, proposal);
    }
    return solving;
  }

  /// Where the model is sure, what solves the task in it is tried, whatever it costs.
  template <class Again>
  void insist_surely(const SearchProblem& problem, SearchResult found, Again again, Proposal& proposal) const {
    if (options_.insist.searches == 0) return;
    const auto solving = insist(problem, std::move(found), again, options_.insist.tolerance, proposal);
    if (solving) take(*solving, proposal);
  }

  /// Where it has doubts, for a little of the return; the search goes on in the means.
  void insist_doubtfully(const SearchProblem& problem, SearchResult found, Proposal& proposal) const {
    const double tolerance = options_.insist.doubtful_tolerance;
    if (tolerance == 0) return;
    const auto again = [&](Index i) {
      SearchResult result = search_means(problem, {proposal.theta}, i, proposal);
      result.predicted_return = with_doubts(problem, result.theta, proposal).predicted_return;
      return result;
    };
    const auto solving = insist(problem, std::move(found), again, tolerance, proposal);
    if (solving && keeps(*solving, *proposal.predicted_return, tolerance)) take(*solving, proposal);
  }

  /// Of what a search has found: the policy that most often solves the task; among those that never do where doubts
  /// count, one that does without them.
  std::optional<SearchResult> best_that_solves(const SearchProblem& problem, SearchResult found,
                                               Proposal& proposal) const {
    std::vector<Vector> policies = std::move(found.runners_up);
    policies.insert(policies.begin(), std::move(found.theta));
    SearchOptions means = options_.search;
    means.imagine.sample = false;
    means.imagine.measurement_noise = 0;
    means.selection = 1;
    const Vector rates = solving_rates(problem, policies, options_.search, stream(Stage::solving)) +
                         kMeans * solving_rates(problem, policies, means, stream(Stage::mean_solving));
    proposal.rollouts += rates.size() * (comparisons(problem, options_.search) + comparisons(problem, means));
    Index best = 0;
    const double solving = rates.maxCoeff(&best);
    if (solving == 0) return std::nullopt;
    SearchResult judged = with_doubts(problem, policies[static_cast<std::size_t>(best)], proposal);
    judged.solving = solving;
    return judged;
  }

  void carry(std::vector<Vector> policies, std::vector<Vector>& carried) const {
    carried = std::move(policies);
    if (static_cast<Index>(carried.size()) > options_.carried)
      carried.resize(static_cast<std::size_t>(options_.carried));
  }

  /// The random numbers of this trial; `search` counts the searches of a stage.
  StreamKey stream(Stage stage, Index search = 0) const {
    return {.seed = setting_.seed,
            .trial = trial(),
            .phase = setting_.phase,
            .stage = stage,
            .search = static_cast<std::uint64_t>(search)};
  }

  SearchResult search_means(SearchProblem problem, const std::vector<Vector>& starts, Index i,
                            Proposal& proposal) const {
    problem.expected = nullptr;
    SearchOptions options = options_.search;
    options.imagine.sample = false;
    SearchResult found = search_policy(problem, starts, options, stream(Stage::mean_search, i));
    count(found, proposal);
    return found;
  }

  static void count(const SearchResult& found, Proposal& proposal) {
    proposal.rollouts += found.rollouts;
    proposal.failed_rollouts += found.failed_rollouts;
  }

  static void take(const SearchResult& found, Proposal& proposal) {
    proposal.theta = found.theta;
    proposal.predicted_return = found.predicted_return;
  }

  /// More than the best return seen by a fraction of it.
  bool promises(double predicted, double gain) const {
    const double best = *std::max_element(first_return(), returns_.end());
    return predicted - best > gain * std::abs(best);
  }

  /// Of a trial with a policy.
  std::vector<double>::const_iterator first_return() const {
    const bool scheduled =
        !setting_.prior && options_.first_trial.kind != FirstTrial::Kind::policy;  // trial 1 had no policy
    return returns_.begin() + (scheduled && !returns_.empty());
  }

  /// Where descents start: the best policy observed, good ones of the last search, and examples of the policy.
  std::vector<Vector> known_policies() const {
    std::vector<Vector> starts;
    const auto first = first_return();
    if (options_.start_from_best && first != returns_.end()) {
      const auto best = std::max_element(first, returns_.end()) - returns_.begin();
      starts.push_back(policies_[static_cast<std::size_t>(best)]);
    }
    if (options_.start_from_last && first != returns_.end() && (starts.empty() || starts.back() != policies_.back()))
      starts.push_back(policies_.back());
    starts.insert(starts.end(), carried_.begin(), carried_.end());
    if (!options_.start_from_examples) return starts;
    const Matrix examples = setting_.policy->examples();
    for (const auto& example : examples.rowwise()) starts.emplace_back(example.transpose());
    return starts;
  }

  Setting setting_;
  Options options_;
  FeatureMap features_;
  Dataset data_;
  std::vector<double> returns_;
  std::vector<Vector> policies_, carried_;
  identification::WarmStart state_;
  std::optional<Proposal> proposal_;
};

bool needs_prior(const Options& options) { return !std::holds_alternative<identification::ZeroMean>(options.model); }

std::vector<std::string> violations_with(const Options& options, const Task& task, const policy::Policy& policy) {
  if (options.search.evaluation == Evaluation::moments)
    if (auto refused = without_moments(options, task, policy); !refused.empty()) return refused;
  if (!options.reward.learned || !needs_prior(options) || task.initial_reward) return {};
  return {
      "reward.learned = true, but the scenario gives no initial_reward for the first search, on the prior: give it one "
      "(of those built in: initial_reward_width), or choose a learner without a prior"};
}

class Builder final : public LearnerBuilder {
 public:
  Builder(std::string name, std::string summary, identification::Kind model)
      : name_(std::move(name)), summary_(std::move(summary)) {
    options_.model = std::move(model);
    if (!needs_prior(options_)) options_.search.imagine.noise_clip = 0;
  }
  std::string name() const override { return name_; }
  std::string summary() const override { return summary_; }
  PriorUse prior_use() const override { return needs_prior(options_) ? PriorUse::required : PriorUse::none; }
  bool chooses_priors() const override {
    return std::holds_alternative<identification::GpMi>(options_.model) ||
           std::holds_alternative<identification::Mi>(options_.model);
  }
  void fields(FieldVisitor& v) override { options_.fields(v); }
  std::vector<std::string> violations(const Task& task, const policy::Policy& policy) const override {
    return violations_with(options_, task, policy);
  }
  std::unique_ptr<Learner> build(Setting setting) const override { return make(std::move(setting), options_); }

 private:
  std::string name_, summary_;
  Options options_;
};

}  // namespace

void FirstTrial::fields(FieldVisitor& v) {
  v.choice("kind", kind, {"actions", "extremes", "policy"}, published("policy"));
  v.number("hold_s", hold_s, at_least(0), published(0, kAuthors));
}

void Exploration::fields(FieldVisitor& v) {
  v.number("gain", gain, at_least(0), published(0));
  v.number("promise", promise, at_least(0));
}

void Scouting::fields(FieldVisitor& v) {
  v.integer("policies", policies, at_least(0), published(0));
  v.number("tolerance", tolerance, at_least(0));
}

void Insistence::fields(FieldVisitor& v) {
  v.integer("searches", searches, between(0, 1000), published(0));
  v.number("tolerance", tolerance, at_least(0));
  v.number("doubtful_tolerance", doubtful_tolerance, at_least(0), published(0));
}

void Options::fields(FieldVisitor& v) {
  std::visit([&](auto& kind) { v.group("model", kind); }, model);
  v.group("reward", reward);
  v.group("search", search);
  v.group("first_trial", first_trial);
  v.boolean("start_from_best", start_from_best);
  v.boolean("start_from_last", start_from_last);
  v.boolean("start_from_examples", start_from_examples, published(false));
  v.group("explore", explore);
  v.group("scout", scout);
  v.group("insist", insist);
  v.boolean("success_test", success_test, published(false));
  v.integer("carried", carried, at_least(0), published(0));
  v.integer("prior_searches", prior_searches, between(1, 1000));
  v.number("prior_variance", prior_variance, at_least(0));
}

/// A learner that learns the reward knows neither it nor when the task is solved.
void forget_reward(Task& task) {
  task.reward = nullptr;
  task.saturating_reward.reset();
  task.solved = nullptr;
}

std::unique_ptr<Learner> make(Setting setting, Options options) {
  Violations violations;
  for (const auto& line : field_violations([&](FieldVisitor& v) { options.fields(v); })) violations.add(line);
  for (const auto& line : setting.task.violations()) violations.add(line);
  violations.require(!needs_prior(options) || setting.prior, "this learner needs a prior");
  violations.require(static_cast<bool>(setting.policy), "this learner needs a policy");
  if (setting.policy)
    for (const auto& line : violations_with(options, setting.task, *setting.policy)) violations.add(line);
  violations.throw_if_any();
  if (!needs_prior(options)) setting.prior.reset();
  if (options.reward.learned) forget_reward(setting.task);
  if (!options.success_test) setting.task.solved = nullptr;
  if (!setting.evaluator) setting.evaluator = make_thread_evaluator(1);
  return std::make_unique<BlackDrops>(std::move(setting), std::move(options));
}

std::vector<std::unique_ptr<LearnerBuilder>> builders() {
  std::vector<std::unique_ptr<LearnerBuilder>> all;
  const auto add = [&](const char* name, const char* summary, identification::Kind kind) {
    all.push_back(std::make_unique<Builder>(name, summary, std::move(kind)));
  };
  add("black-drops", "GPs from data alone; the first trial is random actions", identification::ZeroMean{});
  add("black-drops-prior", "GPs around the prior as it is given", identification::FixedPrior{});
  add("gp-mi", "GPs around the prior, its parameters identified together with the GPs", identification::GpMi{});
  add("mi", "the prior's parameters identified from data, no GP", identification::Mi{});
  return all;
}

}  // namespace rehearse::learners::black_drops
