// The room if MuJoCo was not found: its functions throw and say so.

#include "rehearse/core/errors.hpp"
#include "rehearse/mujoco/drawing.hpp"
#include "rehearse/mujoco/plant.hpp"
#include "rehearse/mujoco/simulator.hpp"

namespace rehearse::mujoco {
namespace {

[[noreturn]] void refuse(const std::string& path = "this") {
  throw InvalidInput(path + " is a model of MuJoCo, which was not found when this program was built");
}

}  // namespace

std::vector<std::string> field_names(const std::string&) { return {}; }
SharedModel compile(const ModelDescription& description) { refuse(description.path); }
Index timesteps(const SharedModel&) { refuse(); }
std::shared_ptr<const system::Simulator> make_simulator(SharedModel, ParameterSpace) { refuse(); }
Warnings warnings_of(const SharedModel&, const std::vector<Interval>&, const Vector&) { refuse(); }
std::unique_ptr<system::Plant> make_plant(const PlantOptions&) { refuse(); }
scenario::SolidDrawing make_drawing(const SharedModel&) { refuse(); }

}  // namespace rehearse::mujoco
