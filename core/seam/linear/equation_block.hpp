// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "seam/field/unknown.hpp"

namespace seam {

/// The equations of one unknown of a field, and what its physics declares of it.
struct EquationUnknown {
  std::string name;
  int components = 1;
  UnknownRole role = UnknownRole::plain;
  NearNullspace near_nullspace = NearNullspace::constants;
  double scale = 0;                 ///< see Unknown; 0: none
  std::vector<int> rows;            ///< [node][component]: local rows, increasing
  std::vector<double> coordinates;  ///< [node][dimension], owned and active
};

/// The equations of one field, for solvers that treat fields and unknowns apart.
struct EquationBlock {
  std::string field;
  int dimension = 2;
  int first = 0;  ///< local row
  int count = 0;  ///< local rows
  std::vector<EquationUnknown> unknowns;
};

/// Changes of an unknown that its equations hardly resist: [mode][row of the unknown].
std::vector<std::vector<double>> near_nullspace(const EquationUnknown& unknown, int dimension);

}  // namespace seam
