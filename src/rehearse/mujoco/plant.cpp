#include "rehearse/mujoco/plant.hpp"

#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "rehearse/mujoco/instance.hpp"

namespace rehearse::mujoco {
namespace {

class ModelPlant final : public system::Plant {
 public:
  explicit ModelPlant(const PlantOptions& options) : around_(options.around), instance_(options.model) {
    instance_.apply(options.phi);
  }

  Vector reset(Rng& rng) override {
    x_ = around_.start(rng);
    rng_ = rng;
    instance_.place(x_);
    return measured(instance_.look());
  }

  Vector step(const Vector& u) override {
    if (!rng_) throw std::logic_error("the plant makes a step before it was reset");
    if (u.size() != instance_.compiled().actions())
      throw InvalidInput(
          fmt::format("an action has {} entries, must have {}", u.size(), instance_.compiled().actions()));
    return measured(instance_.step(u));
  }

  Vector truth() const override { return x_; }

 private:
  Vector measured(bool simulated) {
    if (simulated) instance_.read(x_);
    if (!simulated || !x_.allFinite())
      throw std::runtime_error(fmt::format("MuJoCo's simulation of {} diverged", instance_.compiled().file()));
    return around_.measured(x_, *rng_);
  }

  system::StartAndSensors around_;
  Instance instance_;
  Vector x_;
  std::optional<Rng> rng_;
};

}  // namespace

std::unique_ptr<system::Plant> make_plant(const PlantOptions& options) {
  Violations violations;
  const auto require_size = [&](const char* name, Index size, Index must) {
    violations.require(size == must, fmt::format("{} has {} entries, must have {}", name, size, must));
  };
  require_size("start_mean", options.around.start_mean.size(), options.model->states().size());
  options.around.check(violations);
  require_size("phi", options.phi.size(), options.model->parameters().size());
  violations.throw_if_any();
  return std::make_unique<ModelPlant>(options);
}

}  // namespace rehearse::mujoco
