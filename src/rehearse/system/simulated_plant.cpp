#include "rehearse/system/simulated_plant.hpp"

#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::system {
namespace {

class SimulatedPlant final : public Plant {
 public:
  SimulatedPlant(Motion motion, StartAndSensors around) : motion_(std::move(motion)), around_(std::move(around)) {}

  Vector reset(Rng& rng) override {
    x_ = around_.start_mean;
    for (Index i = 0; i < x_.size(); ++i) x_(i) += around_.start_std(i) * rng.normal();
    rng_ = rng;
    return measured();
  }

  Vector step(const Vector& u) override {
    if (!rng_) throw std::logic_error("the plant makes a step before it was reset");
    x_ = motion_(x_, u);
    return measured();
  }

  Vector truth() const override { return x_; }

 private:
  Vector measured() {
    Vector y = x_;
    for (Index i = 0; i < around_.measurement_std.size(); ++i) y(i) += around_.measurement_std(i) * rng_->normal();
    return y;
  }

  Motion motion_;
  StartAndSensors around_;
  Vector x_;
  std::optional<Rng> rng_;
};

}  // namespace

std::unique_ptr<Plant> make_simulated_plant(Motion motion, StartAndSensors around) {
  const Index n = around.start_mean.size(), noisy = around.measurement_std.size();
  Violations violations;
  violations.require(
      around.start_std.size() == n,
      fmt::format("start_std has {} entries, must have the {} of start_mean", around.start_std.size(), n));
  violations.require(noisy == 0 || noisy == n,
                     fmt::format("measurement_std has {} entries, must have none or the {} of start_mean", noisy, n));
  violations.throw_if_any();
  return std::make_unique<SimulatedPlant>(std::move(motion), std::move(around));
}

}  // namespace rehearse::system
