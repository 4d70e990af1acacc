// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "exact_flow.hpp"
#include "seam/linear/mumps_solver.hpp"
#include "seam/mesh/input/grid.hpp"
#include "seam/record/error_norms.hpp"
#include "seam/solve/newton.hpp"

/// Flows on the unit square or cube, set up as a scene does.
namespace seam::test {

/// A fluid as a scene describes it. @param yaml the keys of the field, `mesh` left out
std::unique_ptr<Physics> make_fluid(int dimension, const std::string& yaml,
                                    const std::map<std::string, double>& parameters = {});

/// The unit square or cube.
struct Box {
  CellType cell = CellType::quadrilateral;
  int cells = 4;          ///< per direction
  bool distorted = true;  ///< lines that are not evenly spaced; quadrilaterals and hexahedra are sheared, too
  [[nodiscard]] int dimension() const { return topology(cell).dimension; }
};
std::unique_ptr<Problem> make_flow(const Box& box, const std::string& yaml,
                                   const std::map<std::string, double>& parameters = {});

/// Marches to `end`, in one static step for steps = 0.
void march(Problem& problem, double end, int steps, double theta = 1);

struct FlowErrors {
  double velocity, gradient, pressure;
};
FlowErrors errors(const Problem& problem, const ExactFlow& exact, double time);

}  // namespace seam::test
