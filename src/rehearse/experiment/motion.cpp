#include "rehearse/experiment/motion.hpp"

#include <nlohmann/json.hpp>

namespace rehearse::experiment {

std::string motion_json(const scenario::Drawing& drawing, const Matrix& states) {
  using Json = nlohmann::ordered_json;
  Json all = {{"format", 1}, {"unit", "m"}, {"goal", nullptr}, {"bodies", Json::array()}, {"frames", Json::array()}};
  if (drawing.goal) all["goal"] = {drawing.goal->x(), drawing.goal->y()};
  for (const scenario::Drawing::Body& body : drawing.bodies)
    all["bodies"].push_back({{"name", body.name}, {"width", body.width_m}});
  for (Index t = 0; t < states.rows(); ++t) {
    Json frame = Json::array();
    for (const scenario::Line& line : drawing.lines(Vector(states.row(t))))
      for (const double coordinate : {line.from.x(), line.from.y(), line.to.x(), line.to.y()})
        frame.push_back(coordinate);
    all["frames"].push_back(frame);
  }
  return all.dump() + "\n";
}

}  // namespace rehearse::experiment
