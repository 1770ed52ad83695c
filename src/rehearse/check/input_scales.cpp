#include "rehearse/check/input_scales.hpp"

#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "rehearse/core/names.hpp"
#include "rehearse/policy/description.hpp"

namespace rehearse::check {
namespace {

constexpr double kLarge = 10, kSmall = 1e-3;  // inputs: units saturate, or are moved by their bias alone
constexpr double kStill = 0.1;                // range of a large input beside its size

const std::vector<policy::Input>* inputs_of(const policy::Description& description) {
  if (const auto* layers = std::get_if<policy::Layers>(&description.form)) return &layers->inputs;
  if (const auto* radial = std::get_if<policy::Radial>(&description.form)) return &radial->inputs;
  return nullptr;
}

/// Empty: the numbers are about as large as 1.
std::string note_on(const StateVariable& state, double scale, const Vector& met) {
  const double most = met.cwiseAbs().maxCoeff(), range = met.maxCoeff() - met.minCoeff();
  const std::string number =
      fmt::format("{} gets to {:.3g}{} under random actions", state.name, most, unit_text(state.unit));
  if (most > kLarge * scale && range < kStill * most)
    return fmt::format(
        "{}, {:.2g} times its scale, and changes by {:.2g} alone: policies see nearly the same number all the time; "
        "count it from where the robot works, for instance from its start",
        number, most / scale, range);
  if (most > kLarge * scale || (most > 0 && most < kSmall * scale))
    return fmt::format(
        "{}, {:.2g} times its scale: policies see {}; scale is to be about the largest value that it takes", number,
        most / scale, most > scale ? "little but its sign" : "next to nothing of it");
  return {};
}

}  // namespace

std::vector<std::string> notes_on_scales(const Task& task, const policy::Policy& policy, const Matrix& X) {
  std::vector<std::string> notes;
  if (X.rows() == 0 || dynamic_cast<const policy::Describable*>(&policy) == nullptr) return notes;
  const policy::Description description = describe(policy, Vector::Zero(policy.parameters()));
  const auto* inputs = inputs_of(description);
  for (std::size_t i = 0; inputs != nullptr && i < inputs->size(); ++i) {
    const policy::Input& input = (*inputs)[i];
    if (input.function != policy::Input::Function::identity || input.state >= X.cols()) continue;
    const std::string note =
        note_on(task.states[static_cast<std::size_t>(input.state)], input.scale, X.col(input.state));
    if (!note.empty()) notes.push_back(note);
  }
  return notes;
}

}  // namespace rehearse::check
