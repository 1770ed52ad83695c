#include "rehearse/learners/pilco/prior_store.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rehearse/learners/test/memory_store.hpp"
#include "slider.hpp"

namespace rehearse::learners::pilco {
namespace {

using nlohmann::json;

const json kWork = {{"done", 3}};

Setting with(const prior::Prior& prior, std::shared_ptr<Store> store) {
  Setting setting = slider::setting();
  setting.prior = prior;
  setting.store = std::move(store);
  return setting;
}

/// A prior of the same parameters whose function is another: it cannot be told apart by its name or its values.
prior::Prior changed() {
  prior::Prior prior = slider::prior(0.5, 0);
  const auto before = prior.simulator;
  prior.simulator = system::make_simulator(
      prior.space, [before](const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) {
        before->change(X, U, phi, dX);
        dX *= 1 + 1e-15;
      });
  return prior;
}

prior::Prior broken() {
  prior::Prior prior = slider::prior(0.5, 0);
  prior.simulator = system::make_simulator(prior.space, [](const ConstMatrixView&, const ConstMatrixView&,
                                                           const Vector&, MatrixView dX) { dX.setConstant(-kNaN); });
  return prior;
}

TEST(PriorStore, FindsWorkOnTheSamePriorAlone) {
  const auto store = std::make_shared<MemoryStore>();
  const Setting setting = with(slider::prior(0.5, 0), store);
  EXPECT_FALSE(kept_work(setting));
  keep_work(setting, kWork);
  EXPECT_EQ(kept_work(setting), kWork);
  EXPECT_EQ(kept_work(with(slider::prior(0.5, 0), store)), kWork);
  EXPECT_FALSE(kept_work(with(slider::prior(0.6, 0), store)));
  EXPECT_FALSE(kept_work(with(changed(), store)));
}

TEST(PriorStore, KnowsAPriorThatFailsEverywhere) {
  const auto store = std::make_shared<MemoryStore>();
  keep_work(with(broken(), store), kWork);
  EXPECT_EQ(kept_work(with(broken(), store)), kWork);
}

TEST(PriorStore, TakesWhatIsNotOfItsOwnForNothing) {
  const auto store = std::make_shared<MemoryStore>();
  for (const char* bytes : {"not CBOR", "\xa0", ""}) {
    store->kept["prior"] = bytes;
    EXPECT_FALSE(kept_work(with(slider::prior(0.5, 0), store)));
  }
}

TEST(PriorStore, MayBeMissing) {
  const Setting setting = with(slider::prior(0.5, 0), nullptr);
  keep_work(setting, kWork);
  EXPECT_FALSE(kept_work(setting));
}

}  // namespace
}  // namespace rehearse::learners::pilco
