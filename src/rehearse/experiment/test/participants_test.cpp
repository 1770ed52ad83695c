#include "rehearse/experiment/participants.hpp"

#include <gtest/gtest.h>

#include "fake.hpp"
#include "rehearse/core/events.hpp"

namespace rehearse::experiment {
namespace {

Resolved line(const Catalogue& catalogue = fake::catalogue()) {
  return resolve(catalogue, {.scenario = "line", .learner = "echo"});
}

TEST(Participants, WorkOnTheOptionsEvaluatorWhichStopsWhereTheOptionsAsk) {
  EXPECT_EQ(evaluator_of({}).get(), &serial_evaluator());
  const auto threads = std::shared_ptr<const Evaluator>(make_thread_evaluator(2));
  EXPECT_EQ(evaluator_of({.evaluator = threads}), threads);
  bool stop = false;
  const Participants participants(line(), {.stop = [&] { return stop; }});
  EXPECT_NO_THROW(participants.evaluator().stop_if_asked());
  stop = true;
  EXPECT_THROW(participants.evaluator().stop_if_asked(), Interrupted);
}

TEST(Participants, ThePlantIsConnectedOnceWhenItIsNeeded) {
  int made = 0;
  const Catalogue catalogue =
      fake::catalogue_with([&made](fake::MakePlant make) { return [&made, make] { return ++made, make(); }; });
  Participants participants(line(catalogue), {});
  participants.learner().ask();
  EXPECT_EQ(made, 0);
  const system::Plant& plant = participants.plant();
  EXPECT_EQ(&participants.plant(), &plant);
  EXPECT_EQ(made, 1);
}

TEST(Participants, ProgressIsAboutTheTrialThatWasBegun) {
  class Trials final : public RunListener {
   public:
    std::vector<Index> heard;
    void progress(Index trial, const Progress&) override { heard.push_back(trial); }
  };
  Trials trials;
  Participants participants(line(), {.listener = &trials});
  participants.learner().ask();
  participants.begin_trial(4);
  participants.learner().ask();
  EXPECT_EQ(trials.heard, (std::vector<Index>{1, 4}));
}

}  // namespace
}  // namespace rehearse::experiment
