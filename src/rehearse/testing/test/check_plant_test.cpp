#include "rehearse/testing/check_plant.hpp"

#include <limits>
#include <optional>
#include <stdexcept>

#include <gtest/gtest.h>

#include "rehearse/robots/pendubot/pendubot.hpp"

namespace rehearse::testing {
namespace {

Task task() {
  Task task;
  task.states = {{"x", ""}};
  task.actions = {{"u", "", {-1, 1}}};
  task.start_mean = task.start_std = Vector{{0}};
  task.dt_s = 0.1;
  task.horizon = 5;
  return task;
}

enum class Fault { none, forgets_reset, own_random, wrong_size, nan, wrong_truth, throws };

class Made final : public system::Plant {
 public:
  explicit Made(Fault fault) : fault_(fault) {}
  Vector reset(Rng& rng) override {
    if (fault_ != Fault::forgets_reset) x_ = 0;
    x_ += rng.normal();
    if (fault_ == Fault::own_random) x_ += static_cast<double>(++count);
    return Vector{{x_}};
  }
  Vector step(const Vector& u) override {
    x_ += u(0);
    if (fault_ == Fault::wrong_size) return Vector{{x_, x_}};
    if (fault_ == Fault::nan) return Vector{{std::numeric_limits<double>::quiet_NaN()}};
    if (fault_ == Fault::throws) throw std::runtime_error("no answer");
    return Vector{{x_}};
  }
  Vector truth() const override { return fault_ == Fault::wrong_truth ? Vector{{1, 2, 3}} : Vector(); }
  inline static int count = 0;

 private:
  Fault fault_;
  double x_ = 0;
};

std::string check(Fault fault) {
  std::string text;
  for (const std::string& line : check_plant([=] { return std::make_unique<Made>(fault); }, task()))
    text += line + "\n";
  return text;
}

TEST(CheckPlant, AcceptsGoodOnes) {
  EXPECT_EQ(check(Fault::none), "");
  robots::pendubot::Options noisy;
  noisy.ode.start_noise = 0.1;
  noisy.ode.measurement_noise = 0.01;
  for (const auto& options : {robots::pendubot::Options{}, noisy}) {
    const auto scenario = robots::pendubot::make(options);
    EXPECT_EQ(check_plant(scenario.make_plant, scenario.task), std::vector<std::string>{});
  }
}

TEST(CheckPlant, FindsFaults) {
  EXPECT_NE(check(Fault::forgets_reset).find("depends on the ones before"), std::string::npos);
  EXPECT_NE(check(Fault::own_random).find("behaves otherwise"), std::string::npos);
  EXPECT_EQ(check(Fault::wrong_size), "the state at step 1 has 2 entries, must have 1 finite ones\n");
  EXPECT_EQ(check(Fault::nan), "the state at step 1 has 1 entries, must have 1 finite ones\n");
  EXPECT_EQ(check(Fault::wrong_truth), "the truth at step 0 has 3 entries, must have 1 finite ones or none\n");
  EXPECT_EQ(check(Fault::throws), "no answer\n");
}

}  // namespace
}  // namespace rehearse::testing
