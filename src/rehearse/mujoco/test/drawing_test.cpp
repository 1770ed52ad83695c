#include "rehearse/mujoco/drawing.hpp"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "rehearse/mujoco/test/robots.hpp"

namespace rehearse::mujoco {
namespace {

using scenario::Box;
using scenario::Capsule;
using scenario::SolidDrawing;
using scenario::Sphere;

SolidDrawing shapes() {
  return make_drawing(compile(
      {.path = data_file("shapes.xml"), .dt_s = 0.002, .states = {{"x", State::Kind::position, {{"slide"}}, 0}}}));
}

const SolidDrawing::Body& body_of(const SolidDrawing& drawing, const std::string& name) {
  for (const SolidDrawing::Body& body : drawing.bodies)
    if (body.name == name) return body;
  throw InvalidInput(name);
}

TEST(ModelDrawing, HasEveryShownGeom) {
  const SolidDrawing drawing = shapes();
  EXPECT_EQ(drawing.bodies.size(), 7);
  EXPECT_EQ(std::get<Box>(body_of(drawing, "block").shape).size_m, Eigen::Vector3d(0.2, 0.4, 0.6));
  EXPECT_EQ(std::get<Sphere>(body_of(drawing, "carriage").shape).radius_m, 0.15);
  EXPECT_EQ(std::get<Capsule>(body_of(drawing, "carriage 2").shape).length_m, 0.8);
  EXPECT_DOUBLE_EQ(std::get<Capsule>(body_of(drawing, "carriage 3").shape).length_m, 0.6);
  EXPECT_EQ(std::get<Box>(body_of(drawing, "carriage 4").shape).size_m, Eigen::Vector3d(0.8, 0.8, 0.2));
  EXPECT_EQ(std::get<Box>(body_of(drawing, "carriage 5").shape).size_m, Eigen::Vector3d(0.2, 0.4, 0.6));
  EXPECT_EQ(drawing.floor_m, -0.25);
}

TEST(ModelDrawing, PosesFollowTheState) {
  const SolidDrawing drawing = shapes();
  const auto poses = drawing.poses(Vector{{0.7}});
  ASSERT_EQ(poses.size(), drawing.bodies.size());
  EXPECT_NEAR((poses[0].position - Eigen::Vector3d(0.7, 0, 1)).norm(), 0, 1e-12);
  EXPECT_NEAR((poses[1].position - Eigen::Vector3d(0.7, 0.5, 1)).norm(), 0, 1e-12);
  const Eigen::Vector3d along = poses[2].orientation * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR((along - Eigen::Vector3d::UnitX()).norm(), 0, 1e-12);
  EXPECT_THROW(drawing.poses(Vector{{1, 2}}), InvalidInput);
}

/// A corner of the wedge is its geom's place; MuJoCo keeps it about its centre of mass and turned.
TEST(ModelDrawing, TheBoxAroundAMeshHoldsIt) {
  const SolidDrawing drawing = shapes();
  const scenario::Pose pose = drawing.poses(Vector{{0}}).back();
  const Eigen::Vector3d half = std::get<Box>(body_of(drawing, "wedge").shape).size_m / 2;
  for (const Eigen::Vector3d& corner :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 1), Eigen::Vector3d(0, 1, 1), Eigen::Vector3d(0, 0, 2)}) {
    const Eigen::Vector3d inside = pose.orientation.inverse() * (corner - pose.position);
    EXPECT_TRUE((inside.cwiseAbs().array() <= half.array() + 1e-6).all()) << corner.transpose();
  }
}

TEST(ModelDrawing, AMeshIsReadFromItsFile) {
  const SolidDrawing drawing = make_drawing(compile({.path = data_file("wedge.xml"), .dt_s = 0.002}));
  const Eigen::Vector3d size = std::get<Box>(body_of(drawing, "wedge").shape).size_m;
  EXPECT_GE(size.maxCoeff(), 3);
  EXPECT_EQ(drawing.floor_m, std::nullopt);
}

TEST(ModelDrawing, AnglesOfStatesTurnLinks) {
  const auto poses = make_drawing(compile(acrobot_model())).poses(Vector{{M_PI / 2, 0, 0, 0}});
  EXPECT_NEAR((poses[0].position - Eigen::Vector3d(0.5, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((poses[1].position - Eigen::Vector3d(1, 0, -0.5)).norm(), 0, 1e-12);
}

TEST(ModelDrawing, ThreadsMayAskAtOnce) {
  const SolidDrawing drawing = shapes();
  std::atomic<int> wrong = 0;  // poses of another state
  const auto ask = [&](double x) {
    for (int i = 0; i < 200; ++i) wrong += drawing.poses(Vector{{x}})[0].position.x() != x;
  };
  std::thread other(ask, 1.0);
  ask(2.0);
  other.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace rehearse::mujoco
