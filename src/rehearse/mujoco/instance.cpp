#include "rehearse/mujoco/instance.hpp"

#include <cmath>

#include <fmt/format.h>

namespace rehearse::mujoco {
namespace {

/// The count of warnings at which a simulation begins. MuJoCo writes a text, which all threads share, at the first
/// warning, that of count 0, so ours begin above. It resets data that go bad, and the count to 0: then that is other,
/// too.
constexpr int kNoWarnings = 2;

void assign(double* to, const Vector& from) { Vector::Map(to, from.size()) = from; }

}  // namespace

Instance::Instance(SharedModel compiled)
    : compiled_(std::move(compiled)), model_(copy(compiled_->original())), data_(make_data(*model_)) {
  start_over();
  const auto numbers = [](const double* from, int size) -> Vector { return Vector::Map(from, size); };
  qpos_ = numbers(data_->qpos, model_->nq);
  qvel_ = numbers(data_->qvel, model_->nv);
  act_ = numbers(data_->act, model_->na);
  ctrl_ = numbers(data_->ctrl, model_->nu);
}

void Instance::apply(const Vector& phi) {
  const Index size = compiled_->parameters().size();
  if (phi.size() != size) throw InvalidInput(fmt::format("phi has {} values, must have {}", phi.size(), size));
  if (phi_.size() == size && (phi_.array() == phi.array()).all()) return;
  for (Index i = 0; i < size; ++i)
    if (!std::isfinite(phi(i))) throw InvalidInput(fmt::format("phi({}) = {}, must be finite", i, phi(i)));
  phi_ = Vector();
  if (compiled_->parameters().apply(compiled_->original(), phi, *model_)) {
    const auto set_constants = [model = model_.get(), data = data_.get()] { mj_setConst(model, data); };
    if (const char* error = guarded(set_constants))
      throw InvalidInput(fmt::format("{}: MuJoCo refuses these parameters: {}", compiled_->file(), error));
    start_over();
  }
  phi_ = phi;
}

void Instance::start_over() {
  const int keyframe = compiled_->keyframe();
  if (keyframe < 0)
    mj_resetData(model_.get(), data_.get());
  else
    mj_resetDataKeyframe(model_.get(), data_.get(), keyframe);
  for (mjWarningStat& warning : data_->warning) warning.number = kNoWarnings;
  spoilt_ = false;
}

/// All that a step depends on. mj_resetData would clear megabytes that it does not depend on.
void Instance::place(const Vector& x) {
  if (spoilt_) start_over();
  data_->time = 0;
  assign(data_->qpos, qpos_);
  assign(data_->qvel, qvel_);
  assign(data_->act, act_);
  assign(data_->ctrl, ctrl_);
  std::fill_n(data_->qacc_warmstart, model_->nv, 0.0);
  std::fill_n(data_->qfrc_applied, model_->nv, 0.0);
  compiled_->states().write(x, *data_);
}

bool Instance::diverged() const {
  for (const int bad : {mjWARN_INERTIA, mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC, mjWARN_BADCTRL})
    if (data_->warning[bad].number != kNoWarnings) return true;
  return false;
}

bool Instance::step(const Vector& u) {
  compiled_->act(u, *data_);
  const auto steps = [this] {
    for (Index i = 0; i < compiled_->substeps() && !diverged(); ++i) mj_step(model_.get(), data_.get());
    compiled_->states().prepare(*model_, *data_);
  };
  spoilt_ = guarded(steps) || diverged();
  return !spoilt_;
}

bool Instance::look() {
  const auto prepare = [this] { compiled_->states().prepare(*model_, *data_); };
  spoilt_ = guarded(prepare) || diverged();
  return !spoilt_;
}

bool Instance::place_bodies() {
  const auto compute = [this] { mj_kinematics(model_.get(), data_.get()); };
  spoilt_ = guarded(compute);
  return !spoilt_;
}

std::unique_ptr<Instance> Instances::take(const Vector& phi) const {
  std::unique_ptr<Instance> instance = idle_.take();
  if (!instance) instance = std::make_unique<Instance>(compiled_);
  instance->apply(phi);
  return instance;
}

}  // namespace rehearse::mujoco
