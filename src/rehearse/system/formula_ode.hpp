#pragma once

#include <string>
#include <utility>
#include <vector>

#include "rehearse/system/ode.hpp"

namespace rehearse::system {

/// A differential equation dx/dt = f(x, u; φ) as formulas (expression/formulas.hpp) of the names of states, actions and
/// parameters.
struct OdeFormulas {
  std::vector<std::string> states, actions, parameters;
  std::vector<std::string> angles;                               // of the states; their sines and cosines are cheap
  std::vector<std::pair<std::string, std::string>> definitions;  // names for formulas
  std::vector<std::string> slopes;                               // dx/dt, a formula a state
};

/// The equation, vectorised over rows. Use it for robots whose equation is known at run time alone; one that is
/// compiled (equation_kernel.hpp) is some times as fast. The kernel may be called on any thread. Throws InvalidInput.
OdeKernel formula_kernel(const OdeFormulas& formulas);

}  // namespace rehearse::system
