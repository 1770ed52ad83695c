#include "rehearse/testing/check_plant.hpp"

#include <optional>
#include <stdexcept>

#include <gtest/gtest.h>

#include "rehearse/robots/pendubot/pendubot.hpp"
#include "small_task.hpp"

namespace rehearse::testing {
namespace {

enum class PlantFault { none, forgets_reset, own_random, wrong_size, nan, wrong_truth, throws };

class MadePlant final : public system::Plant {
 public:
  explicit MadePlant(PlantFault fault) : fault_(fault) {}
  Vector reset(Rng& rng) override {
    if (fault_ != PlantFault::forgets_reset) x_ = 0;
    x_ += rng.normal();
    if (fault_ == PlantFault::own_random) x_ += static_cast<double>(++count);
    return Vector{{x_}};
  }
  Vector step(const Vector& u) override {
    x_ += u(0);
    if (fault_ == PlantFault::wrong_size) return Vector{{x_, x_}};
    if (fault_ == PlantFault::nan) return Vector{{kNaN}};
    if (fault_ == PlantFault::throws) throw std::runtime_error("no answer");
    return Vector{{x_}};
  }
  Vector truth() const override { return fault_ == PlantFault::wrong_truth ? Vector{{1, 2, 3}} : Vector(); }
  inline static int count = 0;

 private:
  PlantFault fault_;
  double x_ = 0;
};

std::string check_made_plant(PlantFault fault) {
  return joined(check_plant([=] { return std::make_unique<MadePlant>(fault); }, small_task()));
}

TEST(CheckPlant, AcceptsGoodOnes) {
  EXPECT_EQ(check_made_plant(PlantFault::none), "");
  robots::pendubot::Options noisy;
  noisy.ode.start_noise = 0.1;
  noisy.ode.measurement_noise = 0.01;
  for (const auto& options : {robots::pendubot::Options{}, noisy}) {
    const auto scenario = robots::pendubot::make(options);
    EXPECT_EQ(check_plant(scenario.make_plant, scenario.task), std::vector<std::string>{});
  }
}

TEST(CheckPlant, FindsFaults) {
  EXPECT_NE(check_made_plant(PlantFault::forgets_reset).find("depends on the ones before"), std::string::npos);
  EXPECT_NE(check_made_plant(PlantFault::own_random).find("behaves otherwise"), std::string::npos);
  EXPECT_EQ(check_made_plant(PlantFault::wrong_size), "the state at step 1 has 2 entries, must have 1 finite ones\n");
  EXPECT_EQ(check_made_plant(PlantFault::nan), "the state at step 1 has 1 entries, must have 1 finite ones\n");
  EXPECT_EQ(check_made_plant(PlantFault::wrong_truth),
            "the truth at step 0 has 3 entries, must have 1 finite ones or none\n");
  EXPECT_EQ(check_made_plant(PlantFault::throws), "no answer\n");
}

}  // namespace
}  // namespace rehearse::testing
