#include "rehearse/mujoco/drawing.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "rehearse/mujoco/instance.hpp"

namespace rehearse::mujoco {
namespace {

using Body = scenario::SolidDrawing::Body;
using Shape = decltype(Body::shape);

constexpr int kShownGroups = 3;

struct Piece {
  int geom = 0;
  Eigen::Vector3d middle;  // of the shape, in the geom's frame
  Shape shape;
};

using ConstVector3 = Eigen::Map<const Eigen::Vector3d>;

Shape cylinder(double radius, double half) {
  if (half > radius) return scenario::Capsule{radius, 2 * (half - radius)};
  return scenario::Box{2 * Eigen::Vector3d(radius, radius, half)};
}

/// MuJoCo puts a mesh's origin into its centre of mass, which is not the middle of the box around it.
Piece mesh(const mjModel& model, int geom) {
  const int id = model.geom_dataid[geom];
  const float* vertices = numbers_of<3>(model.mesh_vert, model.mesh_vertadr[id]);
  const Eigen::Map<const Eigen::Matrix3Xf> points(vertices, 3, model.mesh_vertnum[id]);
  const Eigen::Vector3d low = points.rowwise().minCoeff().cast<double>(),
                        high = points.rowwise().maxCoeff().cast<double>();
  return {geom, (low + high) / 2, scenario::Box{high - low}};
}

std::optional<Piece> piece(const mjModel& model, int geom) {
  const ConstVector3 size(numbers_of<3>(model.geom_size, geom));
  const Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  switch (model.geom_type[geom]) {
    case mjGEOM_SPHERE:
      return Piece{geom, middle, scenario::Sphere{size(0)}};
    case mjGEOM_CAPSULE:
      return Piece{geom, middle, scenario::Capsule{size(0), 2 * size(1)}};
    case mjGEOM_CYLINDER:
      return Piece{geom, middle, cylinder(size(0), size(1))};
    case mjGEOM_ELLIPSOID:
    case mjGEOM_BOX:
      return Piece{geom, middle, scenario::Box{2 * size}};
    case mjGEOM_MESH:
      return mesh(model, geom);
    default:
      return {};
  }
}

bool is_shown(const mjModel& model, int geom) {
  const int material = model.geom_matid[geom];
  const float* colour = material < 0 ? numbers_of<4>(model.geom_rgba, geom) : numbers_of<4>(model.mat_rgba, material);
  return model.geom_group[geom] < kShownGroups && colour[3] > 0;
}

/// Its own, or that of its body, with a number from the body's second geom on.
std::string name_of(const mjModel& model, int geom, std::map<int, int>& nameless) {
  if (const char* name = mj_id2name(&model, mjOBJ_GEOM, geom)) return name;
  const int body = model.geom_bodyid[geom], number = ++nameless[body];
  const char* name = mj_id2name(&model, mjOBJ_BODY, body);
  const std::string of = name ? name : fmt::format("body {}", body);
  return number == 1 ? of : fmt::format("{} {}", of, number);
}

void lift_floor(const mjModel& model, const mjData& data, int geom, std::optional<double>& floor_m) {
  constexpr double kLevel = 1 - 1e-9;
  const bool level = data.geom_xmat[9 * geom + 8] > kLevel;
  if (model.geom_type[geom] != mjGEOM_PLANE || !level || model.body_weldid[model.geom_bodyid[geom]] != 0) return;
  floor_m = std::max(floor_m.value_or(data.geom_xpos[3 * geom + 2]), data.geom_xpos[3 * geom + 2]);
}

scenario::Pose pose(const mjData& data, const Piece& piece) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Eigen::Matrix3d turn = Eigen::Map<const RowMajor>(numbers_of<9>(data.geom_xmat, piece.geom));
  const Eigen::Vector3d origin = ConstVector3(numbers_of<3>(data.geom_xpos, piece.geom));
  return {origin + turn * piece.middle, Eigen::Quaterniond(turn).normalized()};
}

/// Places of bodies in a state. Every call at a time has an instance of its own.
class Kinematics {
 public:
  explicit Kinematics(const SharedModel& compiled)
      : instances_(compiled), phi_(compiled->start_values()), states_(compiled->states().size()) {}

  void require(const ConstVectorView& state) const {
    if (state.size() == states_) return;
    throw InvalidInput(fmt::format("a state has {} entries, must have {}", state.size(), states_));
  }

  template <class Use>
  auto at(const Vector& state, Use use) const {
    std::unique_ptr<Instance> instance = instances_.take(phi_);
    instance->place(state);
    if (!instance->place_bodies()) throw std::runtime_error("MuJoCo finds no poses in this state");
    auto result = use(instance->model(), instance->data());
    instances_.give_back(std::move(instance));
    return result;
  }

 private:
  Instances instances_;
  Vector phi_;
  Index states_;
};

}  // namespace

scenario::SolidDrawing make_drawing(const SharedModel& compiled) {
  const auto kinematics = std::make_shared<const Kinematics>(compiled);
  scenario::SolidDrawing drawing;
  std::map<int, int> nameless;
  const auto pieces =
      kinematics->at(Vector::Zero(compiled->states().size()), [&](const mjModel& model, const mjData& data) {
        std::vector<Piece> pieces;
        for (int geom = 0; geom < model.ngeom; ++geom) {
          lift_floor(model, data, geom, drawing.floor_m);
          const std::optional<Piece> shown = is_shown(model, geom) ? piece(model, geom) : std::nullopt;
          if (!shown) continue;
          drawing.bodies.push_back({name_of(model, geom, nameless), shown->shape});
          pieces.push_back(*shown);
        }
        return pieces;
      });
  drawing.poses = [kinematics, pieces](const ConstVectorView& state) {
    kinematics->require(state);
    return kinematics->at(state, [&](const mjModel&, const mjData& data) {
      std::vector<scenario::Pose> poses;
      poses.reserve(pieces.size());
      for (const Piece& each : pieces) poses.push_back(pose(data, each));
      return poses;
    });
  };
  return drawing;
}

}  // namespace rehearse::mujoco
