#include "rehearse/study/log_model.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/study/test/swings.hpp"

namespace rehearse::study {
namespace {

TEST(LogModel, StatesAreFoundByName) {
  EXPECT_EQ(states_named("q,dq", swinging_task()), (std::vector<Index>{1, 0}));
  EXPECT_TRUE(states_named("", swinging_task()).empty());
  EXPECT_THROW(states_named("p", swinging_task()), InvalidInput);
}

TEST(LogModel, StatesAreNamedOnce) {
  try {
    states_named("q,dq,q,p", swinging_task());
    FAIL() << "it takes a state twice";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(std::string(error.what()),
              "zeros = q,dq,q,p has 'q' twice, must name each state once\nzeros: there is no state 'p', did you mean "
              "'q'?");
  }
}

TEST(LogModel, TimesAreAtLeastAStepAndNeverTooManyToCount) {
  Task task = swinging_task();  // of 0.02 s
  EXPECT_EQ(steps_of(0.2, task), 10);
  EXPECT_EQ(steps_of(1e-9, task), 1);
  task.dt_s = 1e-300;
  EXPECT_EQ(steps_of(1e6, task), 1000000000000);
}

TEST(LogModel, TimesAreRefusedThatNoLogHas) {
  Options options;
  const Fields fields = [&](FieldVisitor& v) { options.fields(v); };
  for (const std::string name : {"zero_s", "fit_horizon_s", "every_s"}) {
    for (const auto& [text, number] : {std::pair{"1e300", "1e+300"}, {"0", "0"}}) {
      try {
        set_field(fields, name, text);
        ADD_FAILURE() << name << " takes " << text;
      } catch (const InvalidInput& error) {
        EXPECT_EQ(std::string(error.what()), name + " = " + number + ", must be > 0 and ≤ 1000000");
      }
    }
    EXPECT_TRUE(set_field(fields, name, "1e6"));
  }
}

TEST(LogModel, KnowsNoiseFromMotion) {
  const Task task = swinging_task();
  const prior::Prior prior = swinging_prior();
  Options options;
  options.rows = 150;
  const auto learned = [&](double push) {
    return learn_logs({swinging_log(1, 0, 0.002, push).episode}, task, prior, options, serial_evaluator());
  };
  EXPECT_TRUE(moves(learned(1)));
  EXPECT_FALSE(moves(learned(0)));
  LogModel still = learned(0);
  still.data.states.setConstant(0.1);  // whose mean is not 0.1 to the last digit
  still.data.changes.setZero();
  EXPECT_FALSE(moves(still));
}

}  // namespace
}  // namespace rehearse::study
