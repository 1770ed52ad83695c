#pragma once
// Makes the simulators and plants of a robot's dynamics, by their source. For the sources of this room.

#include <functional>
#include <memory>
#include <optional>

#include "rehearse/files/temporary_folder.hpp"
#include "rehearse/files/toml_reader.hpp"
#include "rehearse/robot_file/robot.hpp"
#include "rehearse/scenario/drawing.hpp"
#include "rehearse/scenario/scenario.hpp"
#include "rehearse/system/plant.hpp"
#include "rehearse/system/program_simulator.hpp"
#include "rehearse/system/simulated_plant.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::robot_file {

/// Compiles the robot's models, once for all that is made of it and of its copies. A violation for everything that they
/// do not have; else the robot is told what to warn of.
void compile_models(Robot& robot, const Task& task, files::FileViolations& violations);

/// Simulators and plants of a robot's [dynamics.NAME].
class DynamicsMaker {
 public:
  /// Makes the folder where programs find their files; it is kept as long as anybody needs it. The robot's models are
  /// compiled.
  explicit DynamicsMaker(const Robot& robot);

  std::shared_ptr<const system::Simulator> simulator(const Variant& variant, Index substeps);
  std::function<std::unique_ptr<system::Plant>()> plant(const Variant& variant,
                                                        const system::StartAndSensors& around) const;

  /// The drawing of the model that the plant or the first prior is; empty: neither is a model.
  std::optional<scenario::Drawing> drawing() const;

  /// A function that reports the processes of these simulators that had to be replaced so far; null: there are none.
  std::function<std::vector<std::string>()> faults() const;

  /// A function that counts the rows that they gave up so far though another try might answer them; null: as above.
  std::function<Index()> lost_rows() const;

  /// A function that throws InvalidInput, with the reason, if a program of a prior does not answer, or the plant's
  /// where it is driven; null if there are no such programs.
  std::function<void(scenario::PlantUse)> require_ready() const;

  /// A function that throws InvalidInput, with the reason, if the plant's program is no simulator; null if it is no
  /// program.
  std::function<void()> require_oracle() const;

 private:
  system::Program program(const Dynamics& dynamics) const;
  bool is_of_a_prior(const Dynamics& dynamics) const;
  bool is_of_the_plant(const Dynamics& dynamics) const;

  const Robot& robot_;
  std::shared_ptr<const files::TemporaryFolder> folder_;  // null: no program has files
  std::vector<std::pair<std::string, std::shared_ptr<const system::ProgramSimulator>>> programs_;  // under their names
};

}  // namespace rehearse::robot_file
