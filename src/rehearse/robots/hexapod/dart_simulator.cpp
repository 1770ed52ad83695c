#include "rehearse/robots/hexapod/dart_simulator.hpp"

#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <shared_mutex>
#include <vector>

#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>
#include <fmt/format.h>

#include "rehearse/robots/hexapod/state.hpp"

namespace rehearse::robots::hexapod {
namespace {

using dart::dynamics::BodyNode, dart::dynamics::Skeleton, dart::dynamics::SkeletonPtr;

constexpr double kStep = 0.01;                           // s
constexpr double kServoTime = std::numbers::pi * kStep;  // s, in which a joint would reach its target
constexpr double kFastestJoint = 120;                    // rad/s; from one limit to the other in kServoTime
constexpr double kErrorReduction = 0.1, kErrorReductionSpeed = 1;

dart::dynamics::Inertia inertia_of(double mass, const Eigen::Vector3d& centre, const Eigen::Vector3d& size) {
  const Eigen::Vector3d moments = box_inertia(size, mass);
  return {mass, centre, moments.asDiagonal()};
}

void add_shape(BodyNode& body, const std::shared_ptr<dart::dynamics::Shape>& shape, const Eigen::Vector3d& middle) {
  auto* node = body.createShapeNodeWith<dart::dynamics::CollisionAspect, dart::dynamics::DynamicsAspect>(shape);
  node->setRelativeTranslation(middle);
  node->getDynamicsAspect()->setFrictionCoeff(1);
  node->getDynamicsAspect()->setRestitutionCoeff(0);
}

BodyNode* add_segment(Skeleton& robot, BodyNode* carrier, Index leg, Segment segment) {
  const SegmentModel model = model_of(segment);
  dart::dynamics::RevoluteJoint::Properties joint;
  joint.mName = fmt::format("joint {} {}", leg, static_cast<int>(segment));  // or DART prints that it names them
  joint.mAxis = model.axis;
  joint.mT_ParentBodyToJoint = mount_of(leg, segment);
  joint.mActuatorType = dart::dynamics::Joint::VELOCITY;
  const BodyNode::AspectProperties name(fmt::format("segment {} {}", leg, static_cast<int>(segment)));
  BodyNode* body = robot.createJointAndBodyNodePair<dart::dynamics::RevoluteJoint>(carrier, joint, name).second;
  body->setInertia(inertia_of(model.mass, model.centre, model.size));
  if (segment == Segment::tibia) add_shape(*body, std::make_shared<dart::dynamics::SphereShape>(kFootRadius), kFoot);
  return body;
}

SkeletonPtr make_robot(Index missing) {
  const SkeletonPtr robot = Skeleton::create("hexapod");
  BodyNode* trunk = robot->createJointAndBodyNodePair<dart::dynamics::FreeJoint>().second;
  trunk->setInertia(inertia_of(kTrunkMass, Eigen::Vector3d::Zero(), kTrunkSize));
  add_shape(*trunk, std::make_shared<dart::dynamics::BoxShape>(kTrunkSize), Eigen::Vector3d::Zero());
  for (Index leg = 0; leg < kLegs; ++leg) {
    if (leg == missing) continue;
    BodyNode* carrier = trunk;
    for (const Segment segment : kSegments) carrier = add_segment(*robot, carrier, leg, segment);
  }
  return robot;
}

SkeletonPtr make_floor() {
  const SkeletonPtr floor = Skeleton::create("floor");
  BodyNode* body = floor->createJointAndBodyNodePair<dart::dynamics::WeldJoint>().second;
  add_shape(*body, std::make_shared<dart::dynamics::BoxShape>(Eigen::Vector3d(100, 100, 1)), {0, 0, -0.5});
  return floor;
}

/// A filter that allows contacts with the floor alone. DART's own filter, which locks a reference to each skeleton, is
/// slow.
class FloorOnly final : public dart::collision::CollisionFilter {
 public:
  explicit FloorOnly(const dart::dynamics::ShapeFrame* floor) : floor_(floor) {}
  bool ignoresCollision(const dart::collision::CollisionObject* a,
                        const dart::collision::CollisionObject* b) const override {
    return a->getShapeFrame() != floor_ && b->getShapeFrame() != floor_;
  }

 private:
  const dart::dynamics::ShapeFrame* floor_;
};

/// One robot in one world, for one thread at a time.
class DartWorld {
 public:
  explicit DartWorld(Index missing) : robot_(make_robot(missing)), world_(dart::simulation::World::create()) {
    dart::constraint::ContactConstraint::setErrorReductionParameter(kErrorReduction);  // or feet stay in the floor
    dart::constraint::ContactConstraint::setMaxErrorReductionVelocity(kErrorReductionSpeed);
    world_->setTimeStep(kStep);
    const SkeletonPtr floor = make_floor();
    auto& solver = *world_->getConstraintSolver();
    solver.setCollisionDetector(dart::collision::DARTCollisionDetector::create());
    solver.getCollisionOption().collisionFilter = std::make_shared<FloorOnly>(floor->getBodyNode(0)->getShapeNode(0));
    world_->addSkeleton(robot_);
    world_->addSkeleton(floor);
    for (Index joint = 0; joint < kJoints; ++joint)
      if (joint / kJointsOfLeg != missing) joints_.push_back(joint);
    angles_.resize(6 + static_cast<Index>(joints_.size()));
    speeds_.resize(angles_.size());
    commands_.resize(angles_.size());
  }

  /// NaN if it is left where DART survives.
  void change(const ConstVectorView& x, const ConstVectorView& u, int steps, Joints moved, double lag_s,
              VectorView dx) {
    set(x);
    for (int i = 0; i < steps && sane(); ++i) {
      command(u, moved == Joints::driven ? kStep * (steps - i) : kServoTime + lag_s);
      if (sane()) step();
    }
    if (sane())
      read(x, dx);
    else
      dx.setConstant(kNaN);
  }

 private:
  void set(const ConstVectorView& x) {
    angles_.head(3) = x.segment(kRotation, 3);
    angles_.segment(3, 3) = x.segment(kPosition, 3);
    speeds_.head(3) = x.segment(kTurning, 3);
    speeds_.segment(3, 3) = x.segment(kMoving, 3);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      angles_(6 + static_cast<Index>(i)) = x(kAngles + joints_[i]);
      speeds_(6 + static_cast<Index>(i)) = x(kSpeeds + joints_[i]);
    }
    commands_.setZero();
    if (!sane()) return;
    robot_->resetAccelerations();
    robot_->clearConstraintImpulses();
    robot_->clearExternalForces();
    robot_->clearInternalForces();
    robot_->setPositions(angles_);
    robot_->setVelocities(speeds_);
  }

  void command(const ConstVectorView& u, double time_s) {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const Index dof = 6 + static_cast<Index>(i);
      commands_(dof) = (u(joints_[i]) - angles_(dof)) / time_s;
    }
  }

  void step() {
    robot_->setCommands(commands_);
    world_->step();
    angles_ = robot_->getPositions();
    speeds_ = robot_->getVelocities();
  }

  bool sane() const {
    const auto joints = static_cast<Index>(joints_.size());
    return angles_.allFinite() && speeds_.allFinite() && commands_.allFinite() &&
           commands_.cwiseAbs().maxCoeff() < kFastestJoint && angles_.head(3).norm() < 10 &&
           angles_.tail(joints).cwiseAbs().maxCoeff() < 10 && angles_.segment(3, 2).cwiseAbs().maxCoeff() < 40 &&
           angles_(5) > -0.1 && angles_(5) < 1 && speeds_.head(3).norm() < 30 && speeds_.segment(3, 3).norm() < 20 &&
           speeds_.tail(joints).cwiseAbs().maxCoeff() < kFastestJoint;
  }

  void read(const ConstVectorView& x, VectorView dx) const {
    dx.segment(kRotation, 3) = rotation_vector(orientation_of_angles()) - x.segment(kRotation, 3);
    dx.segment(kPosition, 3) = angles_.segment(3, 3) - x.segment(kPosition, 3);
    dx.segment(kTurning, 3) = speeds_.head(3) - x.segment(kTurning, 3);
    dx.segment(kMoving, 3) = speeds_.segment(3, 3) - x.segment(kMoving, 3);
    dx.segment(kAngles, kJoints) = -x.segment(kAngles, kJoints);
    dx.segment(kSpeeds, kJoints) = -x.segment(kSpeeds, kJoints);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      dx(kAngles + joints_[i]) += angles_(6 + static_cast<Index>(i));
      dx(kSpeeds + joints_[i]) += speeds_(6 + static_cast<Index>(i));
    }
  }

  Eigen::Quaterniond orientation_of_angles() const {
    return Eigen::Quaterniond(dart::dynamics::FreeJoint::convertToTransform(angles_.head<6>()).linear());
  }

  SkeletonPtr robot_;
  dart::simulation::WorldPtr world_;
  std::vector<Index> joints_;  // that it has, in the order of DART's degrees of freedom
  Eigen::VectorXd angles_, speeds_, commands_;
};

/// Lends worlds. DART shares state when it makes skeletons, so in a process none is made while others step.
class Worlds {
 public:
  template <class Work>
  void with(Index missing, Work work) {
    std::unique_ptr<DartWorld> world = take(missing);
    if (!world) {
      const std::unique_lock alone(making_);
      world = std::make_unique<DartWorld>(missing);
    }
    {
      const std::shared_lock stepping(making_);
      work(*world);
    }
    const std::lock_guard lock(mutex_);
    free_[missing].push_back(std::move(world));
  }

 private:
  std::unique_ptr<DartWorld> take(Index missing) {
    const std::lock_guard lock(mutex_);
    auto& free = free_[missing];
    if (free.empty()) return nullptr;
    std::unique_ptr<DartWorld> world = std::move(free.back());
    free.pop_back();
    return world;
  }

  std::mutex mutex_;
  std::map<Index, std::vector<std::unique_ptr<DartWorld>>> free_;
  static inline std::shared_mutex making_;
};

}  // namespace

std::shared_ptr<const system::Simulator> make_dart_simulator(double dt_s, Joints moved, double lag_s) {
  const auto worlds = std::make_shared<Worlds>();
  const int steps = static_cast<int>(std::lround(dt_s / kStep));
  const auto change = [worlds, steps, moved, lag_s](const ConstMatrixView& X, const ConstMatrixView& U,
                                                    const Vector& phi, MatrixView dX) {
    worlds->with(std::lround(phi(0)), [&](DartWorld& world) {
      Vector dx(X.cols());
      for (Index i = 0; i < X.rows(); ++i) {
        world.change(X.row(i).transpose().eval(), U.row(i).transpose().eval(), steps, moved, lag_s, dx);
        dX.row(i) = dx.transpose();
      }
    });
  };
  return system::make_simulator(ParameterSpace({Parameter::discrete("missing_leg", -1, {-1, 0, 1, 2, 3, 4, 5})}),
                                change);
}

}  // namespace rehearse::robots::hexapod
