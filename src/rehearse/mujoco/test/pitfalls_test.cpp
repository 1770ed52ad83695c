#include "rehearse/mujoco/pitfalls.hpp"

#include <gtest/gtest.h>

#include "rehearse/mujoco/engine.hpp"
#include "rehearse/mujoco/test/robots.hpp"

namespace rehearse::mujoco {
namespace {

// MuJoCo overflows their sizes, and crashes.
TEST(Pitfalls, GiantsAreRefusedByNameBeforeMujocoMakesThem) {
  const std::string complaint = complaint_of([] { load(data_file("giants.xml")); });
  EXPECT_PRED2(says, complaint, "giants.xml: texture 'h>': width × height = 40000 × 40000, all textures and height ");
  EXPECT_PRED2(says, complaint, "must have ≤ 16777216 points together");
  EXPECT_PRED2(says, complaint, "texture 'cube': width × height = 4000 × 1, of a cube of six squares");
  EXPECT_PRED2(says, complaint, "texture 'hidden': width × height = &#52;0000 × 40000");
  EXPECT_PRED2(says, complaint, "giant_ground.xml: hfield 'ground': nrow × ncol = 70000 × 70000");
  EXPECT_FALSE(says(complaint, "'sky'")) << complaint;
  EXPECT_FALSE(says(complaint, "'comment'")) << complaint;
}

TEST(Pitfalls, JointsOfUrdfHaveAKnownType) {
  EXPECT_PRED2(says, complaint_of([] { load(data_file("wheel.urdf")); }),
               "wheel.urdf: joint 'axle': unknown type 'continous', did you mean 'continuous'? (known: revolute, ");
}

TEST(Pitfalls, OtherFilesAreLeftToMujoco) {
  for (const char* file : {"acrobot.xml", "acrobot.urdf", "garbage.xml", "missing.xml", ""})
    EXPECT_NO_THROW(refuse_pitfalls(data_file(file))) << file;
}

}  // namespace
}  // namespace rehearse::mujoco
