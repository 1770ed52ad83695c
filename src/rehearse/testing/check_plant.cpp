#include "rehearse/testing/check_plant.hpp"

#include <exception>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/testing/compare.hpp"

namespace rehearse::testing {
namespace {

struct Record {
  Matrix measured, truth;  // T+1 × dx; truth of no columns where it is not known
};

Vector random_action(const Task& task, Rng& rng) {
  Vector u(task.action_size());
  for (Index i = 0; i < u.size(); ++i) {
    const Interval& bounds = task.actions[static_cast<std::size_t>(i)].bounds;
    u(i) = rng.uniform(bounds.low, bounds.high);
  }
  return u;
}

/// Throws InvalidInput at the first state of a wrong size.
void note(Record& record, Index t, const Vector& state, const Vector& truth, Index size) {
  if (state.size() != size || !state.allFinite())
    throw InvalidInput(
        fmt::format("the state at step {} has {} entries, must have {} finite ones", t, state.size(), size));
  if (truth.size() != 0 && (truth.size() != size || !truth.allFinite()))
    throw InvalidInput(
        fmt::format("the truth at step {} has {} entries, must have {} finite ones or none", t, truth.size(), size));
  record.measured.row(t) = state.transpose();
  if (truth.size() == size) record.truth.row(t) = truth.transpose();
}

Record episode(system::Plant& plant, const Task& task, std::uint64_t seed) {
  const Index T = task.horizon, dx = task.state_size();
  Record record{Matrix(T + 1, dx), Matrix::Zero(T + 1, dx)};
  Rng start({.seed = seed, .purpose = Purpose::start_state}), actions({.seed = seed, .purpose = Purpose::test});
  const Vector first = plant.reset(start);
  note(record, 0, first, plant.truth(), dx);
  for (Index t = 0; t < T; ++t) {
    const Vector state = plant.step(random_action(task, actions));
    note(record, t + 1, state, plant.truth(), dx);
  }
  return record;
}

bool same_record(const Record& a, const Record& b) { return same(a.measured, b.measured) && same(a.truth, b.truth); }

}  // namespace

std::vector<std::string> check_plant(const std::function<std::unique_ptr<system::Plant>()>& make, const Task& task,
                                     std::uint64_t seed) {
  Violations found;
  try {
    const auto plant = make(), other = make();
    const Record first = episode(*plant, task, seed);
    episode(*plant, task, seed + 1);
    found.require(same_record(first, episode(*plant, task, seed)), "an episode depends on the ones before it");
    found.require(same_record(first, episode(*other, task, seed)), "another plant of the same type behaves otherwise");
  } catch (const std::exception& error) {
    found.add(error.what());
  }
  return found.list();
}

}  // namespace rehearse::testing
