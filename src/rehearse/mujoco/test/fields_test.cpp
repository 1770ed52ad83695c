#include "rehearse/mujoco/fields.hpp"

#include <gtest/gtest.h>

#include "rehearse/mujoco/test/robots.hpp"

namespace rehearse::mujoco {
namespace {

TEST(Fields, AreListedByKind) {
  EXPECT_EQ(field_names("body"), (std::vector<std::string>{"inertia", "ipos", "mass", "pos"}));
  EXPECT_EQ(field_names("option"), std::vector<std::string>{"gravity"});
  EXPECT_TRUE(field_names("cloud").empty());
}

TEST(Fields, EntriesAreThoseOfAnyCopy) {
  const ModelPointer model = load(data_file("acrobot.xml")), other = copy(*model);
  Violations violations;
  const Entries entries = find_entries(*model, {"body", "lower", "ipos", 2}, "p", violations);
  ASSERT_TRUE(violations.empty());
  EXPECT_EQ(entries.size(), 1);
  EXPECT_EQ(*entries.at(*other), -0.5);
  EXPECT_NE(entries.at(*other), entries.at(*model));
}

/// MuJoCo takes shortcuts for geoms and sites that are where the centre of mass is.
TEST(Fields, GeomsAndSitesDoNotFollowACentreOfMass) {
  const ModelPointer model = load(data_file("marked.xml"));
  const auto places = [&] {
    const DataPointer data = make_data(*model);
    mj_forward(model.get(), data.get());
    Vector all(3 * (model->ngeom + model->nsite));
    all << Vector::Map(data->geom_xpos, 3 * model->ngeom), Vector::Map(data->site_xpos, 3 * model->nsite);
    return all;
  };
  const Vector before = places();
  Violations violations;
  const Entries centre = find_entries(*model, {"body", "rod", "ipos", 2}, "p", violations);
  *centre.at(*model) = -0.3;
  centre.field->follow(*model, centre.id);
  EXPECT_EQ(places(), before);
}

TEST(Fields, ABallJointHasThreeDampings) {
  const ModelPointer model = load(data_file("loose.xml"));
  Violations violations;
  EXPECT_EQ(find_entries(*model, {"joint", "socket", "damping"}, "p", violations).size(), 3);
  EXPECT_EQ(find_entries(*model, {"joint", "sea", "armature"}, "p", violations).size(), 6);
}

TEST(Fields, WrongOnesAreNamedWithTheNearest) {
  const ModelPointer model = load(data_file("acrobot.xml"));
  Violations violations;
  find_entries(*model, {"bodi", "lower", "mass"}, "p", violations);
  find_entries(*model, {"body", "lover", "mass"}, "p", violations);
  find_entries(*model, {"body", "lower", "masss"}, "p", violations);
  find_entries(*model, {"geom", "lower", "mass"}, "p", violations);
  find_entries(*model, {"body", "lower", "inertia", 3}, "p", violations);
  EXPECT_EQ(
      violations.list(),
      (std::vector<std::string>{
          "p: there is no kind 'bodi', did you mean 'body'? (known: body, joint, geom, actuator, tendon, option)",
          "p: there is no body 'lover', did you mean 'lower'? (known: world, upper, lower)",
          "p: body has no field 'masss', did you mean 'mass'? (known: inertia, ipos, mass, pos)",
          "p: geom has no field 'mass', but body has one", "p: component = 3, must be from 0 to 2, or −1 for all"}));
}

TEST(Fields, AGeomsBoundFollowsItsSize) {
  const ModelPointer model = load(data_file("shapes.xml")), other = copy(*model);
  for (int geom = 0; geom < model->ngeom; ++geom) {
    if (!mj_id2name(model.get(), mjOBJ_GEOM, geom)) continue;
    Violations violations;
    const Entries size =
        find_entries(*model, {"geom", mj_id2name(model.get(), mjOBJ_GEOM, geom), "size"}, "p", violations);
    other->geom_rbound[geom] = model->geom_rbound[geom];
    size.field->follow(*other, geom);
    EXPECT_NEAR(other->geom_rbound[geom], model->geom_rbound[geom], 1e-12) << geom;
  }
}

}  // namespace
}  // namespace rehearse::mujoco
