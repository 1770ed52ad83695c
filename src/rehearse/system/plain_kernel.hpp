#pragma once

#include "rehearse/system/ode.hpp"

namespace rehearse::system {

/// The sizes of an equation.
struct OdeSizes {
  Index states = 0, actions = 0, parameters = 0;
};

/// A kernel of any equation, a lambda for instance, row by row. Use it for a robot of one's own where no more is wanted
/// than to write its equation down; equation_kernel.hpp is some thirty times as fast. An equation that makes dxdt
/// another size throws InvalidInput at its first use.
OdeKernel plain_kernel(const Ode& ode, const OdeSizes& sizes);

/// A simulator of such an equation, whose states and actions are as many as it is given.
std::shared_ptr<const Simulator> make_ode_simulator(Ode ode, ParameterSpace parameters, double dt_s, Index substeps);

}  // namespace rehearse::system
