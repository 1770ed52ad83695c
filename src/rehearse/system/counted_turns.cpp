#include "rehearse/system/counted_turns.hpp"

#include <utility>

namespace rehearse::system {
namespace {

class CountedPlant final : public Plant {
 public:
  CountedPlant(std::unique_ptr<Plant> robot, Turns turns) : robot_(std::move(robot)), turns_(std::move(turns)) {}

  Vector reset(Rng& rng) override {
    turns_.begin();
    return measured_ = turns_.counted(robot_->reset(rng));
  }

  Vector step(const Vector& u) override { return measured_ = turns_.counted(robot_->step(u)); }
  bool ended() const override { return robot_->ended(); }
  void finish() noexcept override { robot_->finish(); }
  void require_finished() override { robot_->require_finished(); }
  Vector truth() const override { return turns_.beside(robot_->truth(), measured_); }

 private:
  std::unique_ptr<Plant> robot_;
  Turns turns_;
  Vector measured_;
};

}  // namespace

std::unique_ptr<Plant> with_turns_counted(std::unique_ptr<Plant> robot, Turns turns) {
  return std::make_unique<CountedPlant>(std::move(robot), std::move(turns));
}

}  // namespace rehearse::system
