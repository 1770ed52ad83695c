#pragma once

#include "rehearse/experiment/catalogue.hpp"

namespace rehearse::apps {

/// Every robot and learner of this build.
experiment::Catalogue catalogue();

/// The catalogue for commands that look at a run and simulate nothing. The run may be one of a program's robot, whose
/// functions are not here.
experiment::Catalogue to_look(experiment::Catalogue catalogue);

/// The JSON schema of robots' files, for editors: schemas/robot.json.
std::string robot_schema();

/// The file that a robot of one's own begins with: examples/robots/pendulum.toml.
std::string robot_template();

}  // namespace rehearse::apps
