#include "rehearse/mujoco/plant.hpp"

#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "rehearse/mujoco/instance.hpp"

namespace rehearse::mujoco {
namespace {

class ModelPlant final : public system::Plant {
 public:
  ModelPlant(const PlantOptions& options, std::shared_ptr<const CompiledModel> compiled)
      : start_mean_(options.start_mean),
        start_std_(options.start_std),
        measurement_std_(options.measurement_std),
        instance_(std::move(compiled)) {
    instance_.apply(options.phi);
  }

  Vector reset(Rng& rng) override {
    x_ = start_mean_;
    for (Index i = 0; i < x_.size(); ++i) x_(i) += start_std_(i) * rng.normal();
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
      throw std::runtime_error(fmt::format("MuJoCo's simulation of {} diverged", instance_.compiled().path()));
    Vector y = x_;
    for (Index i = 0; i < measurement_std_.size(); ++i) y(i) += measurement_std_(i) * rng_->normal();
    return y;
  }

  Vector start_mean_, start_std_, measurement_std_;
  Instance instance_;
  Vector x_;
  std::optional<Rng> rng_;
};

}  // namespace

std::unique_ptr<system::Plant> make_plant(const PlantOptions& options) {
  auto compiled = std::make_shared<const CompiledModel>(options.model);
  Violations violations;
  const auto require_size = [&](const char* name, Index size, Index must) {
    violations.require(size == must, fmt::format("{} has {} entries, must have {}", name, size, must));
  };
  const Index states = compiled->states().size();
  require_size("start_mean", options.start_mean.size(), states);
  require_size("start_std", options.start_std.size(), states);
  if (options.measurement_std.size() > 0) require_size("measurement_std", options.measurement_std.size(), states);
  require_size("phi", options.phi.size(), compiled->parameters().size());
  violations.throw_if_any();
  return std::make_unique<ModelPlant>(options, std::move(compiled));
}

}  // namespace rehearse::mujoco
