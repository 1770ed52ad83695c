#include "rehearse/system/simulated_plant.hpp"

#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace rehearse::system {
namespace {

class SimulatedPlant final : public Plant {
 public:
  SimulatedPlant(Motion motion, StartAndSensors around) : motion_(std::move(motion)), around_(std::move(around)) {}

  Vector reset(Rng& rng) override {
    x_ = around_.start(rng);
    rng_ = rng;
    return around_.measured(x_, *rng_);
  }

  Vector step(const Vector& u) override {
    if (!rng_) throw std::logic_error("the plant makes a step before it was reset");
    x_ = motion_(x_, u);
    return around_.measured(x_, *rng_);
  }

  Vector truth() const override { return x_; }

 private:
  Motion motion_;
  StartAndSensors around_;
  Vector x_;
  std::optional<Rng> rng_;
};

}  // namespace

Vector StartAndSensors::start(Rng& rng) const {
  Vector x = start_mean;
  for (Index i = 0; i < x.size(); ++i) x(i) += start_std(i) * rng.normal();
  return x;
}

Vector StartAndSensors::measured(const Vector& state, Rng& rng) const {
  Vector y = state;
  for (Index i = 0; i < measurement_std.size(); ++i) y(i) += measurement_std(i) * rng.normal();
  return y;
}

void StartAndSensors::check(Violations& violations) const {
  const Index n = start_mean.size(), noisy = measurement_std.size();
  violations.require(start_std.size() == n,
                     fmt::format("start_std has {} entries, must have the {} of start_mean", start_std.size(), n));
  violations.require(noisy == 0 || noisy == n,
                     fmt::format("measurement_std has {} entries, must have none or the {} of start_mean", noisy, n));
}

std::unique_ptr<Plant> make_simulated_plant(Motion motion, StartAndSensors around) {
  Violations violations;
  around.check(violations);
  violations.throw_if_any();
  return std::make_unique<SimulatedPlant>(std::move(motion), std::move(around));
}

std::unique_ptr<Plant> make_simulated_plant(std::shared_ptr<const Simulator> simulator, Vector phi,
                                            StartAndSensors around) {
  const auto motion = [simulator = std::move(simulator), phi = std::move(phi)](const Vector& x,
                                                                               const Vector& u) -> Vector {
    Matrix change(1, x.size());
    change_contained(*simulator, x.transpose(), u.transpose(), phi, change);
    return x + change.transpose();
  };
  return make_simulated_plant(motion, std::move(around));
}

}  // namespace rehearse::system
