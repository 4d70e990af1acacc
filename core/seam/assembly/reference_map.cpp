// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "seam/assembly/domains.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"

namespace seam {

void attach_cell(ElementSide& side, const Field& field, int cell, int part) {
  side.field = &field;
  side.global_cell = field.mesh().global_cell(cell);
  side.geometry = field.mesh().geometry(cell);
  side.diameter = field.mesh().diameter(cell);
  side.nodes.resize(field.blocks().size());
  for (std::size_t b = 0; b < side.nodes.size(); ++b)
    side.nodes[b] = field.cell_nodes(static_cast<int>(b), cell, part);
}

void invert_map(const ElementSide& side, const double* position, double* guess) {
  const Mesh& mesh = side.field->mesh();
  const int dim = mesh.dimension();
  static thread_local ElementSide probe;
  static thread_local ShapeTable table;
  probe.field = side.field;
  probe.global_cell = side.global_cell;
  probe.geometry = side.geometry;
  double last = 1e300;
  for (int iteration = 0; iteration < 30; ++iteration) {
    tabulate(mesh.type(), mesh.order(), guess, 1, false, table);
    probe.table[mesh.order() - 1] = &table;
    probe.map_geometry();
    double step = 0;
    for (int j = 0; j < dim; ++j) {
      double update = 0;
      for (int i = 0; i < dim; ++i)
        update += probe.inverse_jacobian[j * dim + i] * (position[i] - probe.position[i]);
      guess[j] += update;
      step = std::max(step, std::abs(update));
    }
    // Far from the origin the positions' rounding, not Newton's method, limits the step.
    if (step < 1e-14 || (step < 1e-6 && step > 0.1 * last)) return;
    last = step;
  }
  throw Error(fmt::format("no reference coordinates found for a point on a face of cell {} of mesh '{}'",
                          side.global_cell, mesh.name()));
}

std::optional<PlaceInCell> locate(const ElementSide& side, const double* position) {
  const Mesh& mesh = side.field->mesh();
  const int dim = mesh.dimension();
  const bool simplex = is_simplex(mesh.type());
  PlaceInCell place{std::vector<double>(dim, simplex ? 1.0 / (dim + 1) : 0.5), 0};
  try {
    invert_map(side, position, place.reference.data());
  } catch (const Error&) {
    return std::nullopt;
  }
  double sum = 0;
  for (const double x : place.reference) {
    place.outside = std::max({place.outside, -x, simplex ? 0.0 : x - 1});
    sum += x;
  }
  if (simplex) place.outside = std::max(place.outside, sum - 1);
  return place;
}

}  // namespace seam
