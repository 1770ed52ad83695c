#pragma once

#include "rehearse/core/kinematics.hpp"
#include "rehearse/core/types.hpp"
#include "rehearse/dynamics/dynamics_model.hpp"

namespace rehearse::dynamics {

// Positions follow from their rates by the trapezoid rule; GPs of positions learn what it leaves (after Amadio 2022,
// whose positions are integrals alone). X: n × dx states, Y: n × dx changes or their means. Without a prior the
// position moves by dt·v + dt/2·Δv; around a prior the residual of v adds dt/2 of itself to that of the position.

/// Moves the positions among `states`, as they are at X, half a step on with their rates.
void add_half_step(const Kinematics& kinematics, const ConstMatrixView& X, MatrixView states);

/// Turns Y into targets of the GPs. Y holds changes (without a prior) or changes minus the prior mean.
void subtract_integrals(const Kinematics& kinematics, const ConstMatrixView& X, bool has_prior, MatrixView Y);

/// The inverse, for the means that the GPs predict.
void add_integrals(const Kinematics& kinematics, const ConstMatrixView& X, bool has_prior, MatrixView mean);

/// Adds to the variances of positions what their rates bring.
void add_variances_of_integrals(const Kinematics& kinematics, MatrixView variance);

/// Adds to derivatives by states X (n × dx, or more columns) those by the states that add_half_step makes of X.
void add_half_step_of_derivatives(const Kinematics& kinematics, const ConstMatrixView& by_halfway, MatrixView by);

/// Does the same as add_integrals and add_variances_of_integrals for the derivatives of means and variances.
void add_integrals_of_derivatives(const Kinematics& kinematics, bool has_prior, Linearised& at);

}  // namespace rehearse::dynamics
