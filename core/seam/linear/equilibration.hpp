// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/linear/equation_block.hpp"
#include "seam/linear/matrix.hpp"

namespace seam {

/// What residuals are measured by: a factor for each unknown's equations, such that what one unknown's
/// equations leave counts as much as another's, whatever units either has. Factors of the equations and
/// scales of the unknowns are those with which the blocks that couple one unknown to another are of sizes as
/// near to one as can be, in the mean of the squares of their logarithms (Curtis and Reid, J. Inst. Maths
/// Applics 10 (1972), 118-124, there of entries); scales that unknowns declare stay. Collective.
/// @return [owned row]; 1 where there is nothing to compare
std::vector<double> equation_weights(const Matrix& a, const std::vector<EquationBlock>& blocks);

}  // namespace seam
