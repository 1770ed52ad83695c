#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "rehearse/core/feature_map.hpp"
#include "rehearse/policy/policy.hpp"
#include "rehearse/policy/squash.hpp"

namespace rehearse::policy {

/// One number that a policy sees: a state, or its cosine or sine, divided by `scale`.
struct Input {
  enum class Function { identity, cosine, sine };
  Index state = 0;
  Function function = Function::identity;
  double scale = 1;
};

/// u = squash(output · [v, 1]), where v are the units tanh(hidden · [inputs, 1]).
struct Layers {
  std::vector<Input> inputs;
  Matrix hidden;  // units × (inputs + 1), the bias last; no rows: v are the inputs themselves
  Matrix output;  // actions × (units or inputs + 1)
  Squash squash;
};

/// u = squash(a) with a = Σ_c weight_c exp(−½ Σ_i (input_i − centre_ci)² / length_i²), lengths and weights of its own
/// for each action.
struct Radial {
  std::vector<Input> inputs;
  Matrix centres;  // centres × inputs
  Matrix lengths;  // actions × inputs
  Matrix weights;  // actions × centres
  Squash squash;
};

/// Open loop: at time t the row round(t · per_s), counted from 0. After the last row it begins again if it is periodic,
/// and is held otherwise.
struct Table {
  Matrix actions;  // rows × actions, inside their bounds
  double per_s = 1;
  bool periodic = false;
};

/// u = action + gain · (x − state), moved into its bounds, of the row t · per_s, counted from 0; between two rows u is
/// that of both, linearly, and the last one is held. Differences of angles are taken the shorter way round: less 2π ·
/// floor(difference / 2π + ½).
struct Feedback {
  Matrix actions;  // rows × actions
  Matrix states;   // rows × states
  Matrix gains;    // rows × actions · states: the gains of an action one after the other
  double per_s = 1;
  std::vector<bool> angles;  // which states are
};

/// Near a state: where (x − state)ᵀ shape (x − state) < 1, u = action + gain · (x − state), moved into its bounds,
/// whatever the form says. Differences of angles are those of Feedback.
struct Near {
  Vector action, state;
  Matrix gain;   // actions × states
  Matrix shape;  // states × states
  std::vector<bool> angles;
};

/// A policy at one θ as plain numbers, for exports (exported.hpp).
struct Description {
  std::variant<Layers, Radial, Table, Feedback> form;
  std::optional<Near> near = {};
};

/// A policy that can be described as numbers. A Policy of one's own that is to be exported implements it, too.
class Describable {
 public:
  virtual ~Describable() = default;

  /// theta: finite, as many as the policy's parameters().
  virtual Description describe(const ConstVectorView& theta) const = 0;
};

/// Throws InvalidInput if the policy is not Describable, or θ is of another size or not finite.
Description describe(const Policy& policy, const ConstVectorView& theta);

/// Features as inputs. scale: one a feature. Throws InvalidInput if there are none, or they are of joints, which no
/// policy has.
std::vector<Input> inputs_of(const FeatureMap& features, const Vector& scale);

}  // namespace rehearse::policy
