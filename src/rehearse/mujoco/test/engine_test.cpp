#include "rehearse/mujoco/engine.hpp"

#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "rehearse/mujoco/test/robots.hpp"

namespace rehearse::mujoco {
namespace {

constexpr const char* kLog = "MUJOCO_LOG.TXT";

TEST(Engine, LoadsMjcfAndUrdf) {
  EXPECT_EQ(load(data_file("acrobot.xml"))->njnt, 2);
  EXPECT_EQ(load(data_file("acrobot.urdf"))->njnt, 2);
}

TEST(Engine, SaysInMujocosWordsWhatIsWrongWithAFile) {
  const auto complaint = [](const char* file) { return complaint_of([&] { load(data_file(file)); }); };
  EXPECT_PRED2(says, complaint("missing.xml"), "missing.xml: ");
  EXPECT_PRED2(says, complaint("missing.xml"), "XML_ERROR_FILE_NOT_FOUND");
  EXPECT_PRED2(says, complaint("typo.xml"), "typo.xml: ");
  EXPECT_PRED2(says, complaint("typo.xml"), "unrecognized attribute");
  EXPECT_PRED2(says, complaint("garbage.xml"), "garbage.xml: ");
  EXPECT_PRED2(says, complaint("no_mesh.xml"), "lost.stl");
  EXPECT_PRED2(says, complaint("bad_mesh.xml"), "bad_mesh.xml: ");
  EXPECT_PRED2(says, complaint(""), ": ");
}

TEST(Engine, ErrorsAndWarningsPrintNothingAndEndNothing) {
  std::filesystem::remove(kLog);
  load(data_file("pendulum.xml"));
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  EXPECT_STREQ(guarded([] { mju_error("worn out"); }), "worn out");
  EXPECT_STREQ(guarded([] { mju_error_i("joint %d broke", 3); }), "joint 3 broke");
  mju_warning("worn");
  EXPECT_THROW(mju_error("nobody guards"), std::runtime_error);
  complaint_of([] { load(data_file("typo.xml")); });
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_FALSE(std::filesystem::exists(kLog));
}

TEST(Engine, AGuardIsThatOfItsThreadAndOfTheInnermostCall) {
  load(data_file("pendulum.xml"));
  std::string inner, other, outer;
  const auto work = [&] {
    inner = guarded([] { mju_error("inner"); });
    std::thread([&] { other = guarded([] { mju_error("other"); }); }).join();
    mju_error("outer");
  };
  outer = guarded([&work] { work(); });
  EXPECT_EQ(inner + other + outer, "innerotherouter");
  EXPECT_EQ(guarded([] {}), nullptr);
}

TEST(Engine, NamesAreFoundOrTheNearestIsNamed) {
  const ModelPointer model = load(data_file("acrobot.xml"));
  Violations violations;
  EXPECT_EQ(find(*model, mjOBJ_JOINT, "elbow", "here", violations), 1);
  EXPECT_TRUE(violations.empty());
  EXPECT_EQ(find(*model, mjOBJ_JOINT, "elbov", "here", violations), -1);
  EXPECT_EQ(find(*model, mjOBJ_SENSOR, "gyro", "there", violations), -1);
  EXPECT_EQ(violations.list()[0], "here: there is no joint 'elbov', did you mean 'elbow'? (known: shoulder, elbow)");
  EXPECT_EQ(violations.list()[1], "there: there is no sensor 'gyro': the model has none with a name");
}

TEST(Engine, FreeAndBallJointsAreNotSupported) {
  const ModelPointer model = load(data_file("loose.xml"));
  Violations violations;
  EXPECT_EQ(find_scalar_joint(*model, "sea", "x", violations), -1);
  EXPECT_EQ(find_scalar_joint(*model, "socket", "x", violations), -1);
  EXPECT_GE(find_scalar_joint(*model, "pole", "x", violations), 0);
  ASSERT_EQ(violations.list().size(), 2);
  EXPECT_PRED2(says, violations.list()[0], "free joint, must be a hinge or a slide");
  EXPECT_PRED2(says, violations.list()[1], "ball joint");
}

}  // namespace
}  // namespace rehearse::mujoco
