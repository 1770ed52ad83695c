#include "rehearse/mujoco/fields.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/names.hpp"
#include "rehearse/core/options.hpp"

namespace rehearse::mujoco {
namespace {

/// MuJoCo skips work for bodies whose centre of mass is their origin, and for geoms and sites that are there. It may be
/// so no longer.
void forget_shortcuts(mjModel& model, int body) {
  model.body_sameframe[body] = 0;
  for (int geom = 0; geom < model.ngeom; ++geom)
    if (model.geom_bodyid[geom] == body) model.geom_sameframe[geom] = 0;
  for (int site = 0; site < model.nsite; ++site)
    if (model.site_bodyid[site] == body) model.site_sameframe[site] = 0;
  model.body_simple[body] = 0;
  std::fill_n(model.dof_simplenum, model.nv, 0);
}

/// The radius about its middle within which MuJoCo looks for contacts of a geom.
void bound(mjModel& model, int geom) {
  const double* size = numbers_of<3>(model.geom_size, geom);
  double& radius = model.geom_rbound[geom];
  switch (model.geom_type[geom]) {
    case mjGEOM_SPHERE:
      radius = size[0];
      break;
    case mjGEOM_CAPSULE:
      radius = size[0] + size[1];
      break;
    case mjGEOM_CYLINDER:
      radius = std::hypot(size[0], size[1]);
      break;
    case mjGEOM_BOX:
      radius = std::hypot(size[0], size[1], size[2]);
      break;
    case mjGEOM_ELLIPSOID:
      radius = std::max({size[0], size[1], size[2]});
      break;
    default:
      break;  // a plane has no bound, and the size of a mesh does not shape it
  }
}

constexpr bool kConstants = true;

constexpr Field kFields[] = {
    {"body", "mass", mjOBJ_BODY, 1, [](mjModel& m, int i) { return m.body_mass + i; }, kConstants},
    {"body", "inertia", mjOBJ_BODY, 3, [](mjModel& m, int i) { return numbers_of<3>(m.body_inertia, i); }, kConstants},
    {"body", "ipos", mjOBJ_BODY, 3, [](mjModel& m, int i) { return numbers_of<3>(m.body_ipos, i); }, kConstants,
     forget_shortcuts},
    {"body", "pos", mjOBJ_BODY, 3, [](mjModel& m, int i) { return numbers_of<3>(m.body_pos, i); }, kConstants},
    {"joint", "damping", mjOBJ_JOINT, 0, [](mjModel& m, int i) { return m.dof_damping + m.jnt_dofadr[i]; }},
    {"joint", "frictionloss", mjOBJ_JOINT, 0, [](mjModel& m, int i) { return m.dof_frictionloss + m.jnt_dofadr[i]; }},
    {"joint", "armature", mjOBJ_JOINT, 0, [](mjModel& m, int i) { return m.dof_armature + m.jnt_dofadr[i]; },
     kConstants},
    {"joint", "stiffness", mjOBJ_JOINT, 1, [](mjModel& m, int i) { return m.jnt_stiffness + i; }},
    {"geom", "friction", mjOBJ_GEOM, 3, [](mjModel& m, int i) { return numbers_of<3>(m.geom_friction, i); }},
    {"geom", "size", mjOBJ_GEOM, 3, [](mjModel& m, int i) { return numbers_of<3>(m.geom_size, i); }, false, bound},
    {"geom", "pos", mjOBJ_GEOM, 3, [](mjModel& m, int i) { return numbers_of<3>(m.geom_pos, i); }, false,
     [](mjModel& m, int i) { m.geom_sameframe[i] = 0; }},
    {"actuator", "gear", mjOBJ_ACTUATOR, 6, [](mjModel& m, int i) { return numbers_of<6>(m.actuator_gear, i); },
     kConstants},
    {"actuator", "gainprm", mjOBJ_ACTUATOR, mjNGAIN,
     [](mjModel& m, int i) { return numbers_of<mjNGAIN>(m.actuator_gainprm, i); }},
    {"actuator", "biasprm", mjOBJ_ACTUATOR, mjNBIAS,
     [](mjModel& m, int i) { return numbers_of<mjNBIAS>(m.actuator_biasprm, i); }},
    {"tendon", "damping", mjOBJ_TENDON, 1, [](mjModel& m, int i) { return m.tendon_damping + i; }},
    {"tendon", "frictionloss", mjOBJ_TENDON, 1, [](mjModel& m, int i) { return m.tendon_frictionloss + i; }},
    {"tendon", "stiffness", mjOBJ_TENDON, 1, [](mjModel& m, int i) { return m.tendon_stiffness + i; }},
    {"option", "gravity", mjOBJ_UNKNOWN, 3, [](mjModel& m, int) { return m.opt.gravity; }},
};

int size_of(const Field& field, const mjModel& model, int id) {
  if (field.size > 0) return field.size;
  const int type = model.jnt_type[id];
  return type == mjJNT_FREE ? 6 : type == mjJNT_BALL ? 3 : 1;
}

std::vector<std::string> kinds() {
  std::vector<std::string> names;
  for (const Field& field : kFields)
    if (!is_among(field.kind, names)) names.emplace_back(field.kind);
  return names;
}

const Field* find_field(const Target& target, const std::string& where, Violations& violations) {
  for (const Field& field : kFields)
    if (target.kind == field.kind && target.field == field.name) return &field;
  const std::vector<std::string> known = field_names(target.kind), all = kinds();
  std::string of_others;  // "mass" of a geom: a body has it
  for (const Field& field : kFields)
    if (target.field == field.name) of_others += fmt::format(", but {} has one", field.kind);
  violations.add(known.empty()
                     ? fmt::format("{}: there is no kind '{}'{}", where, target.kind, suggestions(target.kind, all))
                     : fmt::format("{}: {} has no field '{}'{}", where, target.kind, target.field,
                                   of_others.empty() ? suggestions(target.field, known) : of_others));
  return nullptr;
}

}  // namespace

std::vector<std::string> field_names(const std::string& kind) {
  std::vector<std::string> names;
  for (const Field& field : kFields)
    if (field.kind == kind) names.emplace_back(field.name);
  std::sort(names.begin(), names.end());
  return names;
}

Entries find_entries(mjModel& model, const Target& target, const std::string& where, Violations& violations) {
  const Field* field = find_field(target, where, violations);
  if (!field) return {};
  const int id = field->type == mjOBJ_UNKNOWN ? 0 : find(model, field->type, target.element, where, violations);
  if (id < 0) return {};
  const int size = size_of(*field, model, id);
  if (target.component >= size || target.component < -1) {
    violations.add(
        fmt::format("{}: component = {}, must be from 0 to {}, or −1 for all", where, target.component, size - 1));
    return {};
  }
  const int begin = std::max(0, static_cast<int>(target.component));
  return {field, id, begin, target.component < 0 ? size : begin + 1};
}

}  // namespace rehearse::mujoco
