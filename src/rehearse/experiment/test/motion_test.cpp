#include "rehearse/experiment/motion.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rehearse::experiment {
namespace {

scenario::LineDrawing slider() {
  return {.bodies = {{"block", 0.1}, {"shadow", 0.02}}, .lines = [](const ConstVectorView& state) {
            return std::vector<scenario::Line>{{{state(0), 0}, {state(0) + 1, 2}}, {{state(1), -1}, {state(1), -1}}};
          }};
}

TEST(Motion, HasBothEndsOfEveryBodyInEveryState) {
  scenario::LineDrawing drawing = slider();
  drawing.goal = {{3, 4}};
  EXPECT_EQ(motion_json(drawing, Matrix{{0.1, 7}, {-2, 8}}),
            R"({"format":1,"unit":"m","goal":[3.0,4.0],)"
            R"("bodies":[{"name":"block","width":0.1},{"name":"shadow","width":0.02}],)"
            R"("frames":[[0.1,0.0,1.1,2.0,7.0,-1.0,7.0,-1.0],[-2.0,0.0,-1.0,2.0,8.0,-1.0,8.0,-1.0]]})"
            "\n");
}

TEST(Motion, HasNullsWhereAStateIsNotFinite) {
  const auto json = nlohmann::json::parse(motion_json(slider(), Matrix{{std::nan(""), 1}}));
  EXPECT_TRUE(json["goal"].is_null());
  EXPECT_TRUE(json["frames"][0][0].is_null());
  EXPECT_EQ(json["frames"][0][4], 1);
}

TEST(Motion, HasThePoseOfEveryBodyInSpace) {
  const scenario::SolidDrawing walker{
      .bodies = {{"trunk", scenario::Box{{0.25, 0.5, 1}}},
                 {"foot", scenario::Sphere{0.125}},
                 {"leg", scenario::Capsule{0.5, 2}}},
      .floor_m = -1,
      .poses = [](const ConstVectorView& state) {
        const scenario::Pose upright{{state(0), 2, 3}, Eigen::Quaterniond::Identity()};
        return std::vector<scenario::Pose>{upright, upright, {{4, 5, 6}, {0, 0.5, -0.5, state(1)}}};
      }};
  EXPECT_EQ(motion_json(walker, Matrix{{7, 8}, {-9, std::nan("")}}),
            R"({"format":1,"dimensions":3,"unit":"m","floor":-1.0,"bodies":[)"
            R"({"name":"trunk","shape":"box","size":[0.25,0.5,1.0]},{"name":"foot","shape":"sphere","radius":0.125},)"
            R"({"name":"leg","shape":"capsule","radius":0.5,"length":2.0}],"frames":[)"
            R"([7.0,2.0,3.0,1.0,0.0,0.0,0.0,7.0,2.0,3.0,1.0,0.0,0.0,0.0,4.0,5.0,6.0,0.0,0.5,-0.5,8.0],)"
            R"([-9.0,2.0,3.0,1.0,0.0,0.0,0.0,-9.0,2.0,3.0,1.0,0.0,0.0,0.0,4.0,5.0,6.0,0.0,0.5,-0.5,null]]})"
            "\n");
  scenario::SolidDrawing walking = walker;
  walking.bodies[1].foot = true;
  const auto json = nlohmann::json::parse(motion_json(walking, Matrix{{0, 0}}));
  EXPECT_EQ(json["touching"], walking.touching_m);
  EXPECT_EQ(json["bodies"][1]["foot"], true);
  EXPECT_FALSE(json["bodies"][0].contains("foot"));
  scenario::SolidDrawing floating = walker;
  floating.floor_m.reset();
  EXPECT_TRUE(nlohmann::json::parse(motion_json(floating, Matrix{{0, 0}}))["floor"].is_null());
}

}  // namespace
}  // namespace rehearse::experiment
