#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::robots::pendubot {

/// The physical parameters, in the order of φ. SI units.
struct Constants {
  double m1, m2, l1, l2, b1, b2;
};

/// dxdt (4) at state x (θ̇1, θ̇2, θ1, θ2) under the torque u on the first joint.
void derivative(const double* x, double u, const Constants& constants, double* dxdt);

/// Changes of n states (n × 4, columns `stride` apart) under n torques over dt_s, by `substeps` steps of
/// Dormand–Prince 5; vectorised over rows. A row whose angles turn by more than 30 000 rad comes back as NaN.
void change(const double* X, Index x_stride, const double* U, const Constants& constants, double dt_s, Index substeps,
            double* dX, Index dx_stride, Index rows);

}  // namespace rehearse::robots::pendubot
