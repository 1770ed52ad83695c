#include "rehearse/system/counted_turns.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "rehearse/system/program_simulator.hpp"
#include "rehearse/system/test/programs.hpp"

namespace rehearse::system {
namespace {

constexpr double kWhole = 2 * std::numbers::pi;

/// Its wheel is measured within one turn.
class WrappedWheel final : public Plant {
 public:
  explicit WrappedWheel(std::vector<std::string>& said) : said_(said) {}
  Vector reset(Rng&) override { return Vector{{5, 3}}; }
  Vector step(const Vector&) override { return Vector{{-5, -3}}; }
  bool ended() const override { return true; }
  void finish() noexcept override { said_.emplace_back("finish"); }
  void require_finished() override { said_.emplace_back("require_finished"); }
  Vector truth() const override { return Vector{{0, -3.25}}; }

 private:
  std::vector<std::string>& said_;
};

TEST(CountedTurns, GoOnInMeasurementsAndTruth) {
  std::vector<std::string> said;
  const auto plant = with_turns_counted(std::make_unique<WrappedWheel>(said), Turns({1}, Vector{{0, 3}}));
  Rng rng({.seed = 1});
  for (int episode = 0; episode < 2; ++episode) {
    EXPECT_EQ(plant->reset(rng), (Vector{{5, 3}}));
    EXPECT_EQ(plant->step(Vector{{1}}), (Vector{{-5, kWhole - 3}}));
    EXPECT_EQ(plant->truth(), (Vector{{0, kWhole - 3.25}}));
  }
  EXPECT_TRUE(plant->ended());
  plant->finish();
  plant->require_finished();
  EXPECT_EQ(said, (std::vector<std::string>{"finish", "require_finished"}));
}

TEST(CountedTurns, AreThoseOfAProgram) {
  const Program program = test_program(
      {"sh", "-c",
       R"(while read -r line; do case $line in *rehearse*) echo '{"rehearse":1,"messages":["reset","step"]}';; )"
       R"(*reset*) echo '{"state":[1,3,3],"truth":[1,3,3.25]}';; *) echo '{"state":[1,-3,-3],"truth":[1,-3,-3.25]}';; esac; done)"});
  const StartAndSensors around{Vector{{1, 2, 3}}, Vector::Zero(3), {}, {2}};
  const auto plant = make_program_plant(program, shift_of(3), around);
  Rng rng({.seed = 1});
  for (int episode = 0; episode < 2; ++episode) {
    EXPECT_EQ(plant->reset(rng), (Vector{{1, 3, 3}}));
    EXPECT_EQ(plant->step(Vector{{1}}), (Vector{{1, -3, kWhole - 3}})) << "the second state is no angle";
    EXPECT_EQ(plant->truth(), (Vector{{1, -3, kWhole - 3.25}}));
  }
}

}  // namespace
}  // namespace rehearse::system
