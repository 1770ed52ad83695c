// The room if MuJoCo was not found: its functions throw and say so.

#include "rehearse/core/errors.hpp"
#include "rehearse/mujoco/drawing.hpp"
#include "rehearse/mujoco/plant.hpp"
#include "rehearse/mujoco/simulator.hpp"

namespace rehearse::mujoco {
namespace {

[[noreturn]] void refuse(const ModelDescription& description) {
  throw InvalidInput(description.path + " is a model of MuJoCo, which was not found when this program was built");
}

}  // namespace

std::vector<std::string> field_names(const std::string&) { return {}; }
std::shared_ptr<const system::Simulator> make_simulator(const ModelDescription& description, ParameterSpace) {
  refuse(description);
}
ParameterSpace parameter_space(const ModelDescription& description) { refuse(description); }
Warnings warnings_of(const ModelDescription& description, const std::vector<Interval>&, const Vector&) {
  refuse(description);
}
std::unique_ptr<system::Plant> make_plant(const PlantOptions& options) { refuse(options.model); }
scenario::SolidDrawing make_drawing(const ModelDescription& description) { refuse(description); }

}  // namespace rehearse::mujoco
