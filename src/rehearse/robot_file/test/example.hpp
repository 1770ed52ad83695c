#pragma once

#include <fstream>
#include <sstream>
#include <string>

#include "rehearse/core/errors.hpp"
#include "rehearse/robot_file/robot_file.hpp"

namespace rehearse::robot_file::example {

/// A weight on a spring that a motor pushes: a pendulum's state without its trouble.
inline const std::string kSwing = R"toml(format = 1
name = "swing"
dt_s = 0.1
horizon = 20

[[state]]
name = "rate"
scale = 10
[[state]]
name = "angle"
angle = true
rate = "rate"
start = 3
start_noise = 0.1

[[action]]
name = "u"
unit = "N m"
bounds = [-2, 2]

[define]
height = "cos(angle)"

[reward]
distance = ["1 - height", "sin(angle)"]
width = 0.5

[success]
when = "height > 0.9"
last_s = 0.2

[dynamics.pendulum]
parameters = { m = 1, l = { value = 0.5, unit = "m" } }
define.torque = "u + m * 9.81 * l * sin(angle)"
rate.rate = "torque / (m * l^2)"

[plant]

[prior.heavy]
parameters.m = 1.3
tune.m = [0.5, 2]
)toml";

/// The folder of a robot that names no file.
inline std::optional<std::string> no_files(const std::string&) { return std::nullopt; }

/// The text with one part replaced, which must be there.
inline std::string with(const std::string& part, const std::string& by) {
  std::string text = kSwing;
  const std::size_t at = text.find(part);
  if (at == std::string::npos) throw std::logic_error("the example has no " + part);
  return text.replace(at, part.size(), by);
}

/// The violations of a file, a line each; empty: there is none.
inline std::string complaint_of(const std::string& text, const scenario::ReadFile& folder = no_files) {
  try {
    builder(text, "swing.toml", folder);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

}  // namespace rehearse::robot_file::example
