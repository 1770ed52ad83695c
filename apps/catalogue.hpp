#pragma once

#include "rehearse/experiment/catalogue.hpp"

namespace rehearse::apps {

/// Every robot and learner of this build.
experiment::Catalogue catalogue();

/// The JSON schema of robots' files, for editors: schemas/robot.json.
std::string robot_schema();

/// The file that a robot of one's own begins with: examples/robots/pendulum.toml.
std::string robot_template();

}  // namespace rehearse::apps
