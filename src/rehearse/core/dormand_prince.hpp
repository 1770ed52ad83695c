#pragma once

/// The coefficients of Dormand and Prince 1980, fifth order: stage i begins at x + h Σ_j k<Stage i>[j] k_j, and the
/// step ends at x + h Σ_j kEnd[j] k_j.
namespace rehearse::dormand_prince {

inline constexpr double kStage2[] = {1.0 / 5}, kStage3[] = {3.0 / 40, 9.0 / 40},
                        kStage4[] = {44.0 / 45, -56.0 / 15, 32.0 / 9},
                        kStage5[] = {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                        kStage6[] = {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                        kEnd[] = {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84};

}  // namespace rehearse::dormand_prince
