#include "rehearse/mujoco/instance.hpp"

#include <gtest/gtest.h>

#include "rehearse/mujoco/test/robots.hpp"

namespace rehearse::mujoco {
namespace {

TEST(Instance, ForgetsAfterADivergence) {
  Instance instance(std::make_shared<const CompiledModel>(pendulum_model()));
  instance.apply(Vector());
  const Vector x{{0.5, 1}}, u{{1}};
  const auto reached = [&] {
    instance.place(x);
    EXPECT_TRUE(instance.step(u));
    Vector after(2);
    instance.read(after);
    return after;
  };
  const Vector first = reached();
  instance.place(Vector{{NAN, 0}});
  EXPECT_FALSE(instance.step(u));
  EXPECT_EQ(reached(), first);
  instance.place(x);
  EXPECT_FALSE(instance.step(Vector{{INFINITY}}));
  EXPECT_EQ(reached(), first);
}

TEST(Instances, AreTakenAgain) {
  const Instances instances(std::make_shared<const CompiledModel>(pendulum_model()));
  auto first = instances.take(Vector()), second = instances.take(Vector());
  EXPECT_NE(first, second);
  const Instance* const address = second.get();
  instances.give_back(std::move(second));
  EXPECT_EQ(instances.take(Vector()).get(), address);
  EXPECT_THROW(instances.take(Vector{{1}}), InvalidInput);
}

}  // namespace
}  // namespace rehearse::mujoco
