// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "seam/interface/interface.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// L2 norm of (unknown - exact) and of (gradient - exact gradient) over the field's cells, as they are now
/// where the field moves through space (Physics::moves_through_space). Collective.
struct ErrorNorms {
  double l2 = 0;
  std::optional<double> h1;  ///< on an interface that of the normal derivative
};
/// @param p `output.errors.NAME` of a scene @throws Error where its unknown or the lengths of its lists do
/// not fit the field
void require_known_solution(const FieldEntry& entry, const Parameters& p);
ErrorNorms error_norms(const FieldEntry& entry, const std::string& unknown,
                       const std::vector<Expression>& exact, const std::vector<Expression>& gradient,
                       double time);
/// The same over an interface that one of whose sides is the field. Functions are evaluated at points of the
/// field's mesh; the normal is the interface's. Collective.
ErrorNorms interface_error_norms(const std::vector<InterfacePart>& interface, const FieldEntry& entry,
                                 const std::string& unknown, const std::vector<Expression>& exact,
                                 const std::vector<Expression>& gradient, double time);

}  // namespace seam
