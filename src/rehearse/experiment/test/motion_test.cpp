#include "rehearse/experiment/motion.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rehearse::experiment {
namespace {

scenario::Drawing slider() {
  return {.bodies = {{"block", 0.1}, {"shadow", 0.02}}, .lines = [](const ConstVectorView& state) {
            return std::vector<scenario::Line>{{{state(0), 0}, {state(0) + 1, 2}}, {{state(1), -1}, {state(1), -1}}};
          }};
}

TEST(Motion, HasBothEndsOfEveryBodyInEveryState) {
  scenario::Drawing drawing = slider();
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

}  // namespace
}  // namespace rehearse::experiment
