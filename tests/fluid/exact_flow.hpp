// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "seam/scene/expression.hpp"

namespace seam::test {

/// A solution as text, from which the body force and the traction on x_max follow.
struct ExactFlow {
  std::vector<std::string> velocity, rate;  ///< [dimension], rate = "0" where it is steady
  std::vector<std::string> gradient;        ///< [component][direction]
  std::vector<std::string> laplacian;       ///< [dimension]
  std::string pressure;
  std::vector<std::string> pressure_gradient;
  double density = 1.3, viscosity = 0.07;
  bool convection = true;

  [[nodiscard]] int dimension() const { return static_cast<int>(velocity.size()); }
  [[nodiscard]] std::vector<std::string> body_force() const;
  /// Keys of a field that has this solution: velocity given on all sides but x_max, where the traction is.
  [[nodiscard]] std::string scene(const std::string& more) const;
};

/// Vortices in the plane. @param g factor of time, @param dg its rate
ExactFlow vortices(const std::string& g, const std::string& dg);
/// A flow in space whose curl is parallel to it (Beltrami).
ExactFlow spirals();

/// "[a, b]" with every entry quoted.
std::string quoted(const std::vector<std::string>& entries);
std::vector<Expression> expressions(const std::vector<std::string>& texts);

}  // namespace seam::test
