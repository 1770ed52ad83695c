// No two things that happen in a run draw the same random numbers.

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <ostream>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "apps/catalogue.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/experiment/run.hpp"

namespace rehearse::experiment {
namespace {

using Options = std::vector<std::pair<std::string, std::string>>;

struct Case {
  const char* learner;
  const char* scenario;
  Options options;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.learner << " on " << c.scenario; }

const Options kSmallSearch = {
    {"search.race.max_evaluations", "600"}, {"search.race.descents", "4"}, {"search.race.rounds", "2"},
    {"search.race.judgements", "2"},        {"search.selection", "5"},     {"start_noise", "0.01"},
    {"measurement_noise", "0.01"},          {"evaluations", "2"}};

Options with(Options options, const Options& more) {
  options.insert(options.end(), more.begin(), more.end());
  return options;
}

const Options kSmallRestarts = with(kSmallSearch, {{"search.method", "restarts"},
                                                   {"search.restarts.max_evaluations", "600"},
                                                   {"search.restarts.uncertainty.enabled", "true"},
                                                   {"search.restarts.cmaes.elitism", "true"}});
const Options kSmallGradient = with(kSmallSearch, {{"search.method", "gradient"},
                                                   {"search.gradient.steps", "9"},
                                                   {"search.gradient.particles", "12"},
                                                   {"search.gradient.descents", "3"},
                                                   {"search.gradient.rounds", "2"},
                                                   {"search.gradient.dropout", "0.2"}});
const Options kSmallPilco = {{"policy", "rbf"},
                             {"centres", "5"},
                             {"search.line_searches", "2"},
                             {"start_noise", "0.01"},
                             {"measurement_noise", "0.01"},
                             {"evaluations", "2"}};
const Options kSmallArchive = {{"archive.evaluations", "400"}, {"archive.niches", "50"},
                               {"archive.search.batch", "64"}, {"archive.search.initial", "64"},
                               {"start_noise", "0.01"},        {"evaluations", "2"}};

const Options kFewPlans = {{"search.starts", "3"},     {"search.first_iterations", "5"}, {"search.finalists", "2"},
                           {"search.iterations", "5"}, {"search.selection", "10"},       {"start_noise", "0.01"},
                           {"evaluations", "2"}};

using Use = std::tuple<std::uint64_t, std::uint64_t, Phase, Stage, std::uint64_t, Purpose, std::uint64_t, std::uint64_t,
                       std::uint64_t, std::uint64_t>;

/// The number of times that each stream, or step of one, was opened.
std::map<Use, int> uses_of(const Case& c) {
  std::map<Use, int> uses;
  std::mutex mutex;
  const ObservedStreams observed([&](const StreamKey& k, std::optional<std::uint64_t> step) {
    const std::lock_guard lock(mutex);
    ++uses[{k.seed, k.trial, k.phase, k.stage, k.search, k.purpose, k.descent, k.candidate, k.particle,
            step.value_or(~std::uint64_t{0})}];
  });
  const auto folder =
      std::filesystem::temp_directory_path() / (std::string("rehearse-streams-") + c.learner + "-" +
                                                ::testing::UnitTest::GetInstance()->current_test_info()->name());
  std::filesystem::remove_all(folder);
  start_run(apps::catalogue(), {.scenario = c.scenario, .learner = c.learner, .trials = 3, .options = c.options},
            folder, {});
  std::filesystem::remove_all(folder);
  return uses;
}

/// These compare policies in the same simulated episodes, on purpose.
bool is_shared(Stage stage) {
  return stage == Stage::judging || stage == Stage::solving || stage == Stage::mean_solving;
}

class Streams : public ::testing::TestWithParam<Case> {};

TEST_P(Streams, AreOpenedOnce) {
  const auto uses = uses_of(GetParam());
  EXPECT_GT(uses.size(), 100u);
  int shown = 0;
  for (const auto& [use, times] : uses) {
    const auto [seed, trial, phase, stage, search, purpose, descent, candidate, particle, step] = use;
    if (times == 1 || is_shared(stage) || ++shown > 5) continue;
    ADD_FAILURE() << "opened " << times << " times: trial " << trial << ", phase " << static_cast<int>(phase)
                  << ", stage " << static_cast<int>(stage) << ", search " << search << ", purpose "
                  << static_cast<int>(purpose) << ", descent " << descent << ", candidate " << candidate
                  << ", particle " << particle << ", step " << step;
  }
}

std::string name_of(const ::testing::TestParamInfo<Case>& info) {
  std::string name = info.param.learner;
  std::replace(name.begin(), name.end(), '-', '_');
  return name + "_" + std::to_string(info.index);
}

INSTANTIATE_TEST_SUITE_P(
    Learners, Streams,
    ::testing::Values(Case{"black-drops", "pendulum", kSmallSearch},
                      Case{"black-drops-prior", "pendubot", kSmallSearch}, Case{"gp-mi", "pendubot", kSmallSearch},
                      Case{"gp-mi", "pendubot", with(kSmallSearch, {{"search.hand_over", "true"}})},
                      Case{"mi", "pendubot", kSmallSearch}, Case{"gp-mi", "pendubot", kSmallRestarts},
                      Case{"black-drops", "pendulum", kSmallGradient}, Case{"gp-mi", "pendubot", kSmallGradient},
                      Case{"gp-mi", "cartpole",
                           with(kSmallSearch, {{"track", "0.3"}, {"search.safety.rollouts", "40"}})},
                      Case{"pilco", "pendulum", kSmallPilco},
                      Case{"pilco-prior", "pendulum", with(kSmallPilco, {{"pilco.prior_episodes", "3"}})},
                      Case{"pi-rem", "pendubot", with(kSmallPilco, {{"model.identify", "true"}})},
                      Case{"ite", "pendubot", kSmallArchive}, Case{"gp-ilqg", "pendubot", kFewPlans}),
    name_of);

TEST(StreamsTest, EveryLearnerHasACase) {
  std::set<std::string> tested = {
      "black-drops", "black-drops-prior", "gp-mi", "mi", "pilco", "pilco-prior", "pi-rem", "ite", "gp-ilqg"};
  for (const auto& builder : apps::catalogue().learner_builders()) EXPECT_TRUE(tested.contains(builder->name()));
}

}  // namespace
}  // namespace rehearse::experiment
