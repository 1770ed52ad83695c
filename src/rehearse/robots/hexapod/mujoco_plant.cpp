#include "rehearse/robots/hexapod/mujoco_plant.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include "rehearse/mujoco/engine.hpp"
#include "rehearse/robots/hexapod/state.hpp"

namespace rehearse::robots::hexapod {
namespace {

constexpr double kStep = 0.002;  // s
constexpr double kWeakness = 0.25;

std::string numbers(const Eigen::Vector3d& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

std::string inertial(double mass, const Eigen::Vector3d& centre, const Eigen::Vector3d& size) {
  return fmt::format(R"(<inertial mass="{}" pos="{}" diaginertia="{}"/>)", mass, numbers(centre),
                     numbers(box_inertia(size, mass)));
}

/// The leg's segments from this one on.
std::string leg_xml(Index leg, std::size_t from) {
  if (from == kSegments.size()) return "";
  const Segment segment = kSegments[from];
  const SegmentModel model = model_of(segment);
  const Eigen::Isometry3d mount = mount_of(leg, segment);
  const Eigen::Quaterniond turn(mount.linear());
  std::string xml = fmt::format(R"(<body pos="{}" quat="{} {} {} {}">)", numbers(mount.translation()), turn.w(),
                                turn.x(), turn.y(), turn.z());
  xml += inertial(model.mass, model.centre, model.size);
  xml += fmt::format(R"(<joint name="{}" axis="{}" range="{} {}"/>)", leg * kJointsOfLeg + static_cast<Index>(from),
                     numbers(model.axis), model.limits.low, model.limits.high);
  if (segment == Segment::tibia)
    xml += fmt::format(R"(<geom type="sphere" size="{}" pos="{}"/>)", kFootRadius, numbers(kFoot));
  return xml + leg_xml(leg, from + 1) + "</body>";
}

mujoco::ModelPointer load(const std::string& xml) {
  constexpr const char* name = "hexapod.xml";
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), name, static_cast<int>(xml.size()) + 1);
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), name)], xml.c_str(), xml.size() + 1);
  char error[500] = "";
  mujoco::ModelPointer model(mj_loadXML(name, files.get(), error, sizeof error));
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(fmt::format("MuJoCo cannot load the hexapod: {}", error));
  return model;
}

class MujocoPlant final : public system::Plant {
 public:
  MujocoPlant(const Hardware& hardware, DamagedLegs damaged, double start_noise, double dt_s)
      : hardware_(hardware),
        damaged_(std::move(damaged)),
        start_noise_(start_noise),
        model_(load(mujoco_model(hardware, damaged_.removed()))),
        data_(mujoco::make_data(*model_)),
        steps_(static_cast<int>(std::lround(dt_s / kStep))),
        late_(static_cast<int>(std::lround(hardware.latency_s / kStep))) {
    for (Index joint = 0; joint < kJoints; ++joint) {
      const int id = mj_name2id(model_.get(), mjOBJ_JOINT, std::to_string(joint).c_str());
      if (id >= 0) joints_.push_back({joint, model_->jnt_qposadr[id], model_->jnt_dofadr[id]});
    }
  }

  Vector reset(Rng& rng) override {
    mj_resetData(model_.get(), data_.get());
    data_->qpos[2] = kRestHeight;
    if (start_noise_ > 0) scatter(rng);
    rng_ = rng;
    target_ = late_target_ = Vector::Zero(kJoints);
    mj_forward(model_.get(), data_.get());
    return measured();
  }

  Vector step(const Vector& u) override {
    late_target_ = target_;
    target_ = u;
    for (int i = 0; i < steps_; ++i) {
      push(i < late_ ? late_target_ : target_);
      const auto advance = [model = model_.get(), data = data_.get()] { mj_step(model, data); };
      if (const char* error = mujoco::guarded(advance))
        throw std::runtime_error(fmt::format("MuJoCo's simulation of the hexapod failed: {}", error));
    }
    for (const int bad : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC, mjWARN_BADCTRL})
      if (data_->warning[bad].number > 0) throw std::runtime_error("MuJoCo's simulation of the hexapod diverged");
    return measured();
  }

  Vector truth() const override {
    Vector x = Vector::Zero(kStateSize);
    for (const Joint& joint : joints_) {
      x(kAngles + joint.number) = data_->qpos[joint.angle];
      x(kSpeeds + joint.number) = data_->qvel[joint.speed];
    }
    const double* q = data_->qpos + 3;
    const Eigen::Quaterniond orientation(q[0], q[1], q[2], q[3]);
    x.segment(kRotation, 3) = rotation_vector(orientation);
    x.segment(kPosition, 3) = Eigen::Map<const Eigen::Vector3d>(data_->qpos);
    x.segment(kTurning, 3) = Eigen::Map<const Eigen::Vector3d>(data_->qvel + 3);
    x.segment(kMoving, 3) = orientation.inverse() * Eigen::Map<const Eigen::Vector3d>(data_->qvel);
    return x;
  }

 private:
  struct Joint {
    Index number;
    int angle, speed;  // where MuJoCo keeps them
  };

  /// Nobody puts a robot down twice in the same way.
  void scatter(Rng& rng) {
    for (const Joint& joint : joints_) data_->qpos[joint.angle] = start_noise_ * rng.normal();
    const double heading = start_noise_ * rng.normal();
    data_->qpos[3] = std::cos(heading / 2);
    data_->qpos[6] = std::sin(heading / 2);
  }

  /// A servo's torque falls with its speed.
  void push(const Vector& targets) {
    for (const Joint& joint : joints_) {
      const bool blocked = damaged_.suffer(joint.number, Damage::blocked);
      const double target = blocked ? 0 : targets(joint.number);
      const double angle = data_->qpos[joint.angle], speed = data_->qvel[joint.speed];
      const double strength = damaged_.suffer(joint.number, Damage::weak) ? kWeakness : 1;
      const double most =
          blocked ? 100 * hardware_.stall_torque
                  : strength * hardware_.stall_torque * std::max(0.0, 1 - std::abs(speed) / hardware_.free_speed);
      const double torque = hardware_.stiffness * (target - angle) - hardware_.damping * speed;
      data_->qfrc_applied[joint.speed] = std::clamp(torque, -most, most);
    }
  }

  Vector measured() {
    Vector x = truth();
    const auto blur = [&](Index first, Index count, double std) {
      for (Index i = first; i < first + count; ++i) x(i) += std * rng_->normal();
    };
    for (Index joint = 0; joint < kJoints; ++joint) {  // of a missing leg, too: its sensor lines are open, not silent
      blur(kAngles + joint, 1, hardware_.angle_noise);
      blur(kSpeeds + joint, 1, hardware_.speed_noise);
    }
    blur(kRotation, 6, hardware_.angle_noise);
    blur(kTurning, 6, hardware_.speed_noise);
    return x;
  }

  Hardware hardware_;
  DamagedLegs damaged_;
  double start_noise_;
  mujoco::ModelPointer model_;
  mujoco::DataPointer data_;
  int steps_, late_;
  std::vector<Joint> joints_;
  Vector target_, late_target_;
  std::optional<Rng> rng_;
};

}  // namespace

void Hardware::fields(FieldVisitor& v) {
  v.number("stall_torque", stall_torque, "largest torque of a servo [N m]", above(0));
  v.number("free_speed", free_speed, "speed at which a servo has no torque left [rad/s]", above(0));
  v.number("stiffness", stiffness, "stiffness of the servos' own control [N m/rad]", above(0));
  v.number("damping", damping, "damping of the servos' own control [N m s/rad]", at_least(0));
  v.number("latency_s", latency_s, "time until a target reaches the servos [s]", between(0, 0.1));
  v.number("friction", friction, "friction of feet on the floor", above(0));
  v.number("angle_noise", angle_noise, "standard deviation of the measurement noise of angles and position [rad, m]",
           at_least(0));
  v.number("speed_noise", speed_noise, "standard deviation of the measurement noise of speeds [rad/s, m/s]",
           at_least(0));
}

bool DamagedLegs::suffer(Index joint, Damage what) const {
  const bool here = std::find(legs.begin(), legs.end(), joint / kJointsOfLeg) != legs.end();
  return here && damage == what && (!segment || *segment == segment_of(joint));
}

std::vector<Index> DamagedLegs::removed() const { return damage == Damage::removed ? legs : std::vector<Index>(); }

std::string mujoco_model(const Hardware& hardware, const std::vector<Index>& removed) {
  std::string legs;
  for (Index leg = 0; leg < kLegs; ++leg)
    if (std::find(removed.begin(), removed.end(), leg) == removed.end()) legs += leg_xml(leg, 0);
  return fmt::format(
      R"(<mujoco model="hexapod"><compiler angle="radian" autolimits="true"/><option timestep="{}" cone="elliptic"/>
<default><joint damping="0.05" frictionloss="0.08" armature="0.01"/><geom friction="{} 0.005 0.0001" contype="1" conaffinity="0"/></default>
<worldbody><geom type="plane" size="50 50 1" contype="0" conaffinity="1"/>
<body pos="0 0 {}"><freejoint/>{}<geom type="box" size="{}"/>
{}</body></worldbody></mujoco>)",
      kStep, hardware.friction, kRestHeight, inertial(kTrunkMass, Eigen::Vector3d::Zero(), kTrunkSize),
      numbers(kTrunkSize / 2), legs);
}

std::unique_ptr<system::Plant> make_mujoco_plant(const Hardware& hardware, const DamagedLegs& damaged,
                                                 double start_noise, double dt_s) {
  return std::make_unique<MujocoPlant>(hardware, damaged, start_noise, dt_s);
}

}  // namespace rehearse::robots::hexapod
