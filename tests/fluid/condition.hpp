// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/solve/problem.hpp"

namespace seam::test {

/// Condition number of a flow's tangent, 2-norm, by power iteration on AᵀA and its inverse.
///
/// Unknowns are measured as the continuous problem measures them, whatever the cut: velocity rows and columns
/// by the square root of μ h^(d-2), pressure ones by that of h^d/μ. Scaling with the matrix' own diagonal
/// would hide what a thin cut cell does to it. Rows of prescribed unknowns are left out.
/// @param viscosity Pa s, @param size of the cells, m. On one rank; infinite when there is no inverse
double condition_number(Problem& problem, double viscosity, double size);

}  // namespace seam::test
