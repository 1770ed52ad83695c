#include "rehearse/experiment/motion.hpp"

#include <nlohmann/json.hpp>

namespace rehearse::experiment {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const scenario::LineDrawing& drawing) {
  Json all = {{"format", 1}, {"unit", "m"}, {"goal", nullptr}, {"bodies", Json::array()}};
  if (drawing.goal) all["goal"] = {drawing.goal->x(), drawing.goal->y()};
  for (const scenario::LineDrawing::Body& body : drawing.bodies)
    all["bodies"].push_back({{"name", body.name}, {"width", body.width_m}});
  return all;
}

Json frame_of(const scenario::LineDrawing& drawing, const ConstVectorView& state) {
  Json frame = Json::array();
  for (const scenario::Line& line : drawing.lines(state))
    for (const double coordinate : {line.from.x(), line.from.y(), line.to.x(), line.to.y()})
      frame.push_back(coordinate);
  return frame;
}

struct AddShape {
  Json& body;
  void operator()(const scenario::Box& box) const {
    body["shape"] = "box";
    body["size"] = {box.size_m.x(), box.size_m.y(), box.size_m.z()};
  }
  void operator()(const scenario::Sphere& sphere) const {
    body["shape"] = "sphere";
    body["radius"] = sphere.radius_m;
  }
  void operator()(const scenario::Capsule& capsule) const {
    body["shape"] = "capsule";
    body["radius"] = capsule.radius_m;
    body["length"] = capsule.length_m;
  }
};

Json to_json(const scenario::SolidDrawing& drawing) {
  Json all = {{"format", 1}, {"dimensions", 3}, {"unit", "m"}, {"floor", nullptr}, {"bodies", Json::array()}};
  if (drawing.floor_m) all["floor"] = *drawing.floor_m;
  for (const auto& [name, shape, foot] : drawing.bodies) {
    Json body = {{"name", name}};
    std::visit(AddShape{body}, shape);
    if (foot) {
      body["foot"] = true;
      all["touching"] = drawing.touching_m;
    }
    all["bodies"].push_back(body);
  }
  return all;
}

Json frame_of(const scenario::SolidDrawing& drawing, const ConstVectorView& state) {
  Json frame = Json::array();
  for (const auto& [p, q] : drawing.poses(state))
    for (const double number : {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) frame.push_back(number);
  return frame;
}

}  // namespace

std::string motion_json(const scenario::Drawing& drawing, const Matrix& states) {
  const auto write = [&states](const auto& kind) {
    Json all = to_json(kind);
    all["frames"] = Json::array();
    for (Index t = 0; t < states.rows(); ++t) all["frames"].push_back(frame_of(kind, Vector(states.row(t))));
    return all.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";  // names of bodies may be no UTF-8
  };
  return std::visit(write, drawing);
}

}  // namespace rehearse::experiment
