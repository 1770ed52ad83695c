#include "rehearse/learners/pilco/prior_store.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rehearse::learners::pilco {
namespace {

using nlohmann::json;

constexpr const char* kStored = "prior";
constexpr Index kCompared = 16;  // steps

/// The bits of some steps of the prior, from the task's start under fixed actions all over their bounds: no random
/// numbers, which belong to the learning.
std::vector<std::uint64_t> steps_of(const Setting& setting) {
  const Task& task = setting.task;
  const Vector phi = setting.prior->space.values();
  Matrix X = task.start_mean.transpose(), U(1, task.action_size()), change(1, task.state_size());
  std::vector<std::uint64_t> bits;
  for (Index t = 0; t < kCompared; ++t) {
    for (Index a = 0; a < U.cols(); ++a) {
      const Interval bounds = task.actions[static_cast<std::size_t>(a)].bounds;
      U(0, a) = std::lerp(bounds.low, bounds.high, static_cast<double>((7 * t + 3 * a) % kCompared) / (kCompared - 1));
    }
    setting.prior->mean(X, U, phi, change);
    for (const double number : change.reshaped())
      bits.push_back(std::isnan(number) ? 0 : std::bit_cast<std::uint64_t>(number));
    X = change.allFinite() ? Matrix(X + change) : Matrix(task.start_mean.transpose());
  }
  return bits;
}

}  // namespace

std::optional<json> kept_work(const Setting& setting) {
  const auto bytes = setting.store ? setting.store->read(kStored) : std::nullopt;
  if (!bytes) return {};
  try {
    const json kept = json::from_cbor(*bytes);
    if (kept.at("steps") == json(steps_of(setting))) return kept.at("work");
  } catch (const json::exception&) {  // not one of ours
  }
  return {};
}

void keep_work(const Setting& setting, const json& work) {
  if (!setting.store) return;
  std::string bytes;
  json::to_cbor({{"steps", steps_of(setting)}, {"work", work}}, bytes);
  setting.store->write(kStored, bytes);
}

}  // namespace rehearse::learners::pilco
